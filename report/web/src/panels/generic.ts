// SPDX-License-Identifier: Apache-2.0
// Shows results that no other panel draws as JSON.
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
