// Making elements: the only way this page builds its document. Text is always set as text, never
// parsed as HTML, so that no value in the data can become markup.

export type Child = Node | string | undefined;

/** An element with attributes and children; an undefined attribute or child is left out. */
export function h<K extends keyof HTMLElementTagNameMap>(
  tag: K,
  attributes: Record<string, string | undefined> = {},
  ...children: Child[]
): HTMLElementTagNameMap[K] {
  const element = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (value !== undefined) element.setAttribute(name, value);
  }
  element.append(...children.filter((child) => child !== undefined));
  return element;
}

export function button(
  label: string,
  on_click: () => void,
  class_name = "button",
): HTMLButtonElement {
  const element = h("button", { type: "button", class: class_name }, label);
  element.addEventListener("click", on_click);
  return element;
}

/** Calls `redraw` in the frame after `element` took a new size. */
export function on_resize(element: HTMLElement, redraw: () => void): void {
  new ResizeObserver(() => requestAnimationFrame(redraw)).observe(element);
}

let choices = 0;

/** A row of radio buttons drawn as one switch; keyboard operation is the browser's own. */
export function choice<T extends string>(
  legend: string,
  options: Readonly<Record<T, string>>,
  initial: T,
  on_change: (value: T) => void,
): HTMLFieldSetElement {
  const name = `choice-${++choices}`;
  const labels = (Object.entries(options) as [T, string][]).map(([value, label]) => {
    const input = h("input", { type: "radio", name, value });
    input.checked = value === initial;
    input.addEventListener("change", () => on_change(value));
    return h("label", {}, input, h("span", {}, label));
  });
  return h("fieldset", { class: "choice" }, h("legend", {}, legend), ...labels);
}

/** A button that saves `content()` as a file, without asking any server. */
export function download_button(
  label: string,
  file_name: string,
  content: () => string,
): HTMLElement {
  return button(label, () => {
    const url = URL.createObjectURL(new Blob([content()], { type: "text/csv;charset=utf-8" }));
    h("a", { href: url, download: file_name }).click();
    setTimeout(() => URL.revokeObjectURL(url), 60_000);
  });
}
