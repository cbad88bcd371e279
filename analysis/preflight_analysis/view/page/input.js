// Keyboard and mouse.
import { arrange } from "./arrange.js";
import { isFrame, keyOf, things } from "./graph.js";
import { canvas, details, filter, hint, remember, state } from "./page.js";
import { found, mark, next } from "./search.js";
import { isShown, tabbed, tabTo, walkable } from "./tabs.js";
import { focusOn, follow, light, select, step, walkTo } from "./walk.js";
import { explain } from "./words.js";
import { fit, magnification, zoomTo } from "./zoom.js";

/**
 * @param {Event} event
 * @param {string} selector
 * @returns {SVGElement | undefined}
 */
function closest(event, selector) {
  const found = event.target instanceof Element ? event.target.closest(selector) : null;
  return found === null ? undefined : /** @type {SVGElement} */ (found);
}

/** @param {Event} event */
const itemAt = (event) => closest(event, "[data-node],[data-channel],[data-frame]");

/** @param {Event} event */
const partAt = (event) => closest(event, "[data-node],[data-channel],[data-route],[data-frame]");

/** @param {boolean} isTyping */
function leave(isTyping) {
  hint.hidden = true;
  if (!details.hidden) {
    const back = state.selected === undefined ? undefined : state.graph.items.get(state.selected);
    select(undefined);
    back?.focus({ preventScroll: true });
  } else if (filter.value !== "") {
    const last = found();
    filter.value = "";
    arrange();
    mark();
    if (isTyping) {
      walkTo(last);
    }
    remember();
  } else if (state.focus !== undefined) {
    focusOn(undefined);
  } else if (isTyping) {
    walkTo(tabbed());
  }
  light(undefined);
}

/**
 * @param {KeyboardEvent} event
 * @param {SVGElement | undefined} item
 * @returns {boolean} whether the key means something here
 */
function press({ key }, item) {
  if (key === "/") {
    filter.focus();
    filter.select();
  } else if (key === "+" || key === "=") {
    zoomTo(magnification() * 1.25);
  } else if (key === "-") {
    zoomTo(magnification() / 1.25);
  } else if (key === "0") {
    fit();
  } else if (item && key.startsWith("Arrow")) {
    walkTo(step(item, key));
  } else if (item && key === "Enter") {
    follow(item);
  } else if (item && key === " ") {
    isFrame(item) ? follow(item) : select(keyOf(item));
  } else if (item && key === "f" && !isFrame(item)) {
    focusOn(keyOf(item));
  } else {
    return false;
  }
  return true;
}

/** @type {{x: number, y: number, left: number, top: number, far: boolean} | undefined} */
let drag;

export function listen() {
  document.addEventListener("keydown", (event) => {
    const isTyping = closest(event, "input[type=search]") !== undefined;
    if (!state.isLoaded) {
      return;
    }
    if (event.key === "Escape") {
      leave(isTyping);
      event.preventDefault();
    } else if (isTyping) {
      if (event.key === "Enter") {
        next(event.shiftKey ? -1 : 1);
        event.preventDefault();
      } else if (event.key === "ArrowDown") {
        walkTo(found() ?? things().find((each) => isShown(each) && !each.closest(".context")));
        event.preventDefault();
      }
    } else if (!event.ctrlKey && !event.metaKey && !event.altKey && press(event, itemAt(event))) {
      event.preventDefault();
    }
  });
  canvas.addEventListener("pointerdown", (event) => {
    drag =
      event.button === 0
        ? { x: event.clientX, y: event.clientY, left: canvas.scrollLeft, top: canvas.scrollTop, far: false }
        : undefined;
  });
  addEventListener("pointermove", (event) => {
    if (drag === undefined || event.buttons === 0) {
      drag = event.buttons === 0 ? undefined : drag;
      return;
    }
    const [x, y] = [event.clientX - drag.x, event.clientY - drag.y];
    drag.far ||= Math.hypot(x, y) > 5;
    if (drag.far) {
      canvas.classList.add("dragged");
      hint.hidden = true;
      canvas.scrollTo(drag.left - x, drag.top - y);
    }
  });
  addEventListener("pointerup", () => canvas.classList.remove("dragged"));
  canvas.addEventListener("click", (event) => {
    const part = partAt(event);
    if (drag?.far) {
      drag = undefined;
    } else if (part && (!isFrame(part) || isOnName(event, part))) {
      tabTo(part);
      walkable();
      follow(part);
    } else {
      select(undefined);
    }
  });
  canvas.addEventListener("pointerover", (event) => {
    const part = drag?.far ? undefined : partAt(event);
    if (part && (!isFrame(part) || part.classList.contains("folded"))) {
      light(part);
      explain(part, event.clientX, event.clientY);
    }
  });
  canvas.addEventListener("pointerout", (event) => {
    if (partAt(event)) {
      hint.hidden = true;
      light(undefined);
    }
  });
  canvas.addEventListener("focusin", (event) => {
    const item = itemAt(event);
    if (item?.matches(":focus-visible")) {
      light(item);
    }
  });
  canvas.addEventListener("focusout", () => light(undefined));
  canvas.addEventListener(
    "wheel",
    (event) => {
      if (event.ctrlKey || event.metaKey) {
        event.preventDefault();
        zoomTo(magnification() * Math.exp(-event.deltaY / 400), { x: event.clientX, y: event.clientY });
      }
    },
    { passive: false },
  );
  canvas.addEventListener("scrollend", () => remember());
}

/**
 * Of a namespace that is unfolded the name alone can be clicked: what is in it has no paper of its own.
 * @param {MouseEvent} event
 * @param {SVGElement} part
 */
function isOnName(event, part) {
  const name = part.querySelector(".name")?.getBoundingClientRect();
  return (
    part.classList.contains("folded") ||
    (name !== undefined && event.clientY <= name.bottom + 3 && event.clientX <= name.right + 3)
  );
}
