// The panels, in the order in which they stand in the page. A new panel: its file in panels/ and its line here.
import type { Panel } from "./page";
import { compare } from "./panels/compare";

export const panels: Panel[] = [compare];
