// Values of a map: under the pointer, and of the cell that the arrow keys move to; zoom by buttons, wheel, pinch and keys.
"use strict";
for (const figure of document.querySelectorAll("figure.map")) {
  const map = JSON.parse(document.getElementById("values-" + figure.dataset.values).textContent);
  const svg = figure.querySelector("svg");
  const box = svg.viewBox.baseVal;
  const whole = { x: box.x, y: box.y, width: box.width, height: box.height };
  const kMostZoom = 40;

  const make = (name, parent, properties) => Object.assign(parent.appendChild(document.createElement(name)), properties);
  const frame = document.createElement("div");
  svg.replaceWith(frame);
  frame.append(svg);
  frame.className = "frame";
  frame.tabIndex = 0;
  frame.setAttribute("role", "group");
  frame.setAttribute("aria-label", "Map. Arrow keys move to a cell and tell its values; plus, minus and zero zoom.");
  const controls = document.createElement("div");
  controls.className = "bar";
  frame.after(controls);
  const button = (text, label, act) => {
    const one = make("button", controls, { type: "button", textContent: text, onclick: act });
    one.setAttribute("aria-label", label);
  };
  make("span", controls, { className: "help", textContent: "Values under the pointer, or with the arrow keys." });
  const shown = document.createElement("p");
  shown.className = "values";
  shown.setAttribute("aria-live", "polite");
  controls.after(shown);
  shown.textContent = map.invitation;

  const mark = document.createElementNS(svg.namespaceURI, "rect");
  mark.setAttribute("class", "cell");
  mark.style.display = "none";
  svg.append(mark);

  // From the values of the axes to the picture and back.
  const { left, right, top, bottom } = map.plot;
  const [xs, ys] = [map.x.range, map.y.range];
  const toX = (x) => left + ((x - xs[0]) / (xs[1] - xs[0])) * (right - left);
  const toY = (y) => bottom - ((y - ys[0]) / (ys[1] - ys[0])) * (bottom - top);
  const fromX = (x) => xs[0] + ((x - left) / (right - left)) * (xs[1] - xs[0]);
  const fromY = (y) => ys[0] + ((bottom - y) / (bottom - top)) * (ys[1] - ys[0]);

  // Where cells lie on top of each other, the weakest is shown: kinds are in the order of their strength.
  const weakest = (x, y) => {
    let found = null;
    for (const cell of map.cells) {
      const [x0, x1, y0, y1, kind, samples] = cell;
      if (x < +x0 || x > +x1 || y < +y0 || y > +y1) continue;
      if (!found || kind > found[4] || (kind === found[4] && samples > found[5])) found = cell;
    }
    return found;
  };
  const words = (cell) =>
    map.sentence.replace(/\{(\w+)\}/g, (_, name) =>
      ({ x0: cell[0], x1: cell[1], y0: cell[2], y1: cell[3], z0: cell[6], z1: cell[7],
         kind: map.kinds[cell[4]].replace("{samples}", cell[5]) })[name]);

  let chosen = null;
  const tell = (cell) => {
    chosen = cell;
    mark.style.display = cell ? "" : "none";
    shown.textContent = cell ? words(cell) : map.invitation;
    if (!cell) return;
    const [x0, x1, y0, y1] = [toX(+cell[0]), toX(+cell[1]), toY(+cell[3]), toY(+cell[2])];
    for (const [name, value] of Object.entries({ x: x0, y: y0, width: x1 - x0, height: y1 - y0 })) {
      mark.setAttribute(name, value);
    }
  };

  const place = (event) => {
    const at = new DOMPoint(event.clientX, event.clientY).matrixTransform(svg.getScreenCTM().inverse());
    return { x: at.x, y: at.y };
  };

  const show = (x, y, width) => {
    const share = Math.min(1, Math.max(1 / kMostZoom, width / whole.width));
    box.width = whole.width * share;
    box.height = whole.height * share;
    box.x = Math.min(Math.max(x, whole.x), whole.x + whole.width - box.width);
    box.y = Math.min(Math.max(y, whole.y), whole.y + whole.height - box.height);
    figure.classList.toggle("zoomed", share < 1);
  };
  // What is at this place of the picture stays where it is.
  const zoom = (factor, at) => {
    const width = Math.min(whole.width, Math.max(whole.width / kMostZoom, box.width / factor));
    const ratio = width / box.width;
    show(at.x - (at.x - box.x) * ratio, at.y - (at.y - box.y) * ratio, width);
  };
  const middle = () => {
    if (!chosen) return { x: box.x + box.width / 2, y: box.y + box.height / 2 };
    return { x: toX((+chosen[0] + +chosen[1]) / 2), y: toY((+chosen[2] + +chosen[3]) / 2) };
  };
  const kStep = 1.5;
  button("+", "Zoom in", () => zoom(kStep, middle()));
  button("−", "Zoom out", () => zoom(1 / kStep, middle()));
  button("Whole map", "Show the whole map", () => show(whole.x, whole.y, whole.width));
  controls.append(controls.firstChild); // the help last

  svg.addEventListener("wheel", (event) => {
    if (!event.ctrlKey && document.activeElement !== frame) return; // the page scrolls
    event.preventDefault();
    zoom(Math.exp(-event.deltaY * 0.002), place(event));
  }, { passive: false });

  const pointers = new Map();
  const spread = () => {
    const [a, b] = [...pointers.values()];
    return { distance: Math.hypot(a.clientX - b.clientX, a.clientY - b.clientY),
             clientX: (a.clientX + b.clientX) / 2, clientY: (a.clientY + b.clientY) / 2 };
  };
  svg.addEventListener("pointerdown", (event) => {
    pointers.set(event.pointerId, event);
    const at = place(event);
    tell(weakest(fromX(at.x), fromY(at.y)));
  });
  svg.addEventListener("pointermove", (event) => {
    const before = pointers.get(event.pointerId);
    if (pointers.size === 2 && before) {
      const old = spread();
      pointers.set(event.pointerId, event);
      const now = spread();
      if (old.distance > 0) zoom(now.distance / old.distance, place(now));
      return;
    }
    if (before && figure.classList.contains("zoomed")) {
      const [a, b] = [place(before), place(event)];
      pointers.set(event.pointerId, event);
      show(box.x + a.x - b.x, box.y + a.y - b.y, box.width);
      return;
    }
    const at = place(event);
    tell(weakest(fromX(at.x), fromY(at.y)));
  });
  for (const end of ["pointerup", "pointercancel", "pointerleave"]) {
    svg.addEventListener(end, (event) => pointers.delete(event.pointerId));
  }

  // The cell that begins beyond this one's edge, at its middle.
  const neighbour = (dx, dy) => {
    const [x0, x1, y0, y1] = chosen.slice(0, 4).map(Number);
    const [x, y] = [(x0 + x1) / 2, (y0 + y1) / 2];
    const [stepX, stepY] = [(xs[1] - xs[0]) * 1e-3, (ys[1] - ys[0]) * 1e-3];
    return weakest(dx ? (dx > 0 ? x1 + stepX : x0 - stepX) : x, dy ? (dy > 0 ? y1 + stepY : y0 - stepY) : y) || chosen;
  };
  const bring = () => {
    const at = middle();
    const inside = at.x > box.x && at.x < box.x + box.width && at.y > box.y && at.y < box.y + box.height;
    if (!inside) show(at.x - box.width / 2, at.y - box.height / 2, box.width);
  };
  const kArrows = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] };
  frame.addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.altKey || event.metaKey) return;
    const arrow = kArrows[event.key];
    if (arrow) {
      tell(chosen ? neighbour(...arrow) : weakest((xs[0] + xs[1]) / 2, (ys[0] + ys[1]) / 2));
      bring();
    } else if (event.key === "+" || event.key === "=") {
      zoom(kStep, middle());
    } else if (event.key === "-") {
      zoom(1 / kStep, middle());
    } else if (event.key === "0") {
      show(whole.x, whole.y, whole.width);
    } else if (event.key === "Escape") {
      tell(null);
    } else {
      return;
    }
    event.preventDefault();
  });
}
