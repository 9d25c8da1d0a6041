// SPDX-License-Identifier: Apache-2.0
// DOM helpers without a framework: create, fill, copy to the clipboard.

export type Child = Node | string | number | null | undefined | false | Child[];
type Attributes = Record<string, string | number | boolean | null | undefined | ((event: never) => void)>;

function add(parent: Node, child: Child): void {
  if (child === null || child === undefined || child === false) return;
  if (Array.isArray(child)) for (const each of child) add(parent, each);
  else parent.appendChild(child instanceof Node ? child : document.createTextNode(String(child)));
}

function give(element: Element, attributes: Attributes): void {
  for (const [name, value] of Object.entries(attributes)) {
    if (value === null || value === undefined || value === false) continue;
    if (typeof value === "function") element.addEventListener(name, value as EventListener);
    else element.setAttribute(name, value === true ? "" : String(value));
  }
}

/** h("p", { class: "x", click: f }, "text", child): functions become listeners; null, undefined and false are
 *  omitted. */
export function h<K extends keyof HTMLElementTagNameMap>(
  name: K,
  attributes: Attributes = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(name);
  give(element, attributes);
  add(element, children);
  return element;
}

/** The same for SVG. */
export function s(name: string, attributes: Attributes = {}, ...children: Child[]): SVGElement {
  const element = document.createElementNS("http://www.w3.org/2000/svg", name);
  give(element, attributes);
  add(element, children);
  return element;
}

export function clear(element: Element): void {
  element.replaceChildren();
}

let speaker: HTMLElement | null = null;
let silence: ReturnType<typeof setTimeout> | undefined;

/** Shows a short message below the table of contents, where it hides no values; screen readers read it aloud. */
export function say(text: string): void {
  speaker ??= document.getElementById("said");
  if (!speaker) return;
  speaker.textContent = text;
  speaker.classList.add("shown");
  clearTimeout(silence);
  silence = setTimeout(() => speaker?.classList.remove("shown"), 2500);
}

/** Copies text; if the clipboard refuses, as it may for files on disk, through a selection. */
export async function copy(text: string): Promise<boolean> {
  try {
    await navigator.clipboard.writeText(text);
    return true;
  } catch {
    const area = h("textarea", { class: "off", readonly: true });
    area.value = text;
    document.body.append(area);
    area.select();
    const done = document.execCommand("copy");
    area.remove();
    return done;
  }
}

/** A button that copies a reproducing command, shown as its tooltip. */
export function command_button(command: string, what = "this"): HTMLElement {
  return h(
    "button",
    {
      type: "button",
      class: "copy",
      title: command,
      "aria-label": `Copy the command that makes ${what} again`,
      "data-command": command,
      click: async () => say((await copy(command)) ? "Command copied" : "The browser does not let this page copy"),
    },
    "Copy command",
  );
}
