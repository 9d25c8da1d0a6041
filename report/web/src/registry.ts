// The panels, in the order in which they stand in the page. A new panel: its file in panels/ and its line here.
import type { Panel } from "./page";
import { compare } from "./panels/compare";
import { pictures } from "./panels/pictures";

export const panels: Panel[] = [pictures, compare];
