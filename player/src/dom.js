// SPDX-License-Identifier: GPL-2.0-or-later
// Builds elements of the page. Texts become text nodes, never markup.

/** An HTML element. properties: of the element; children: elements and texts. */
export function element(tag, properties = {}, ...children) {
  const made = Object.assign(document.createElement(tag), properties);
  made.append(...children);
  return made;
}

/** An SVG element. attributes: numbers and texts written in this program. */
export function svg(tag, attributes, ...children) {
  const made = document.createElementNS("http://www.w3.org/2000/svg", tag);
  for (const [name, value] of Object.entries(attributes)) made.setAttribute(name, value);
  made.append(...children);
  return made;
}
