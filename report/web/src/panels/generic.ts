// A result that no panel draws: its JSON, so that nothing that was given is lost.
import { h } from "../dom";
import { verb_of, type Panel } from "../page";

export const generic: Panel = {
  name: "result",
  verbs: [],
  title: (result) => `Result of ${verb_of(result) || "an unnamed verb"}`,
  about: "A result that this page has no drawing for, as it is.",
  render(root, result) {
    root.append(
      h("pre", { tabindex: 0 }, JSON.stringify(result, null, 2)),
    );
  },
};
