// SPDX-License-Identifier: Apache-2.0
// The pictures in the viewer, with the places that a compare's result points out.
import { decoded } from "../codec";
import { h } from "../dom";
import { figure, number_text } from "../figures";
import { lab_links } from "../lab_link";
import { verb_of, type Context, type Panel, type Picture, type Result } from "../page";
import { size_text, subject_of, subject_of_pictures, subject_text } from "../subject";
import { Plane } from "../viewer/plane";
import { Viewer, type Tour } from "../viewer/viewer";
import { Scene } from "../viewer/views";
import "../viewer/viewer.css";

/** The compare of these two pictures, and its index among the results. */
function compared(context: Context, ref: Picture, test: Picture): { result: Result; index: number } | null {
  const of = (picture: Picture, index: number, side: string): boolean => (picture.compared ?? []).includes(`${index}.${side}`);
  const index = context.page.results.findIndex((result, i) => verb_of(result) === "compare" && of(ref, i, "ref") && of(test, i, "test"));
  return index < 0 ? null : { index, result: context.page.results[index] };
}

function tour_of(context: Context, scene: Scene, a: string, b: string): Tour {
  const tour: Tour = { lsb_bits: 8, worst: null, clusters: [], none: "" };
  const pair = scene.pair(a, b);
  if (!pair) return tour;
  const found = compared(context, pair[0].picture, pair[1].picture);
  if (!found) {
    const d = scene.difference(a, b, "colour", 8);
    if (d && d.max > 0) tour.worst = { label: `Worst pixel (${d.worst.x}, ${d.worst.y}): ${number_text(d.max)} LSB`, ...d.worst };
    tour.none = d && d.max > 0 ? "No `compare` of these two is in the report." : "The two hold the same values.";
    return tour;
  }
  const { result, index } = found;
  const show = (path: (string | number)[]): HTMLElement => figure(index, result, path);
  tour.lsb_bits = result.lsb_bits ?? 8;
  const { worst } = result;
  if (worst) {
    tour.worst = {
      label: ["Worst pixel (", show(["worst", "x"]), ", ", show(["worst", "y"]), "): ", show(["worst", "error_lsb"]), " LSB"],
      x: worst.x,
      y: worst.y,
    };
  }
  tour.clusters = (result.clusters ?? []).map((cluster: Result, i: number) => ({
    label: [`Cluster ${i + 1}: `, show(["clusters", i, "pixels"]), " px, ", show(["clusters", i, "max_lsb"]), " LSB"],
    x: cluster.worst.x,
    y: cluster.worst.y,
  }));
  tour.none = `No cluster: no pixel errs by ${number_text(result.cluster_threshold_lsb)} LSB or more.`;
  return tour;
}

/** Size of the picture that a map describes, from its result: maps are enlarged or made of a smaller picture. */
function size_of_map(context: Context, map: Picture): string {
  const base = (name: unknown): string => String(name ?? "").replace(/.*\//, "");
  const results = context.page.results.filter((each) => map.display && each?.blame && base(each.blame) === base(map.from));
  return subject_of([results.find((each) => each.blame === map.from) ?? results[0] ?? {}]).sizes[0] ?? "";
}

async function scenes_of(context: Context): Promise<{ name: string; scene: Scene }[]> {
  const planes = await Promise.all(
    context.pictures.map(async (picture) => new Plane(picture, await decoded(picture, context.block(picture.same_as ?? picture.id)))),
  );
  const groups = new Map<number, Plane[]>();
  for (const plane of planes) {
    const group = plane.picture.group ?? 0;
    groups.set(group, [...(groups.get(group) ?? []), plane]);
  }
  return [...groups.values()].map((members, i) => {
    const of = subject_text(subject_of_pictures(members.map((plane) => plane.picture)));
    const scene = new Scene(members);
    for (const { picture } of members) {
      const size = size_of_map(context, picture);
      if (size && size !== size_text(scene.width, scene.height)) picture.title += ` (of ${size})`;
    }
    return { name: `${i + 1}: ${of || members[0].picture.from}`, scene };
  });
}

export const pictures: Panel = {
  name: "pictures",
  verbs: [],
  wants: (page) => page.pictures.length + page.remarks.length > 0,
  title: "Pictures",
  about: "The pictures that the results name, with the words of every pixel and the error between two of them.",
  async render(root, _result, context) {
    for (const remark of context.page.remarks) root.append(h("p", { class: "note remark" }, remark));
    for (const { title, nonfinite } of context.pictures) {
      if (nonfinite) root.append(h("p", { class: "note remark" }, `${title}: ${nonfinite} values are not finite and are drawn as 0.`));
    }
    if (!context.pictures.length) return;
    const scenes = await scenes_of(context);
    const viewer = h("div");
    root.append(
      viewer,
      h("p", { class: "note" }, "Click a picture, then: wheel or + \u2212 zoom, drag pans, arrows move the pixel that is read, w worst, c next cluster, m how they are shown, [ ] slider, space turns, 0 fit, Esc none."),
      ...context.pictures.filter((p) => p.same_as).map((p) => {
        const same = context.pictures.find((other) => other.id === p.same_as);
        return h("p", { class: "note same" }, `${p.title} and ${same?.title ?? p.same_as}: the same words, every one.`);
      }),
      lab_links(context.pictures) ?? "",
    );
    new Viewer(viewer, scenes, (scene, a, b) => tour_of(context, scene, a, b));
  },
};
