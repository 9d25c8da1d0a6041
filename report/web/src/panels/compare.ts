// `compare`: how far two pictures are from each other.
import { h } from "../dom";
import { figures_of } from "../figures";
import type { Panel } from "../page";

export const compare: Panel = {
  name: "compare",
  verbs: ["compare"],
  title: "Difference",
  render(root, result, context) {
    const show = figures_of(context.index, result);
    root.append(h("p", { class: "lead" }, show(["psnr_db"], { unit: "dB" }), ", worst ", show(["max_abs_lsb"]), " LSB"));
  },
};
