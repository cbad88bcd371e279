// The page of `ros-preflight tree --format html`: a filter, and all branches opened or closed at once.

/** @param {string} id */
const element = (id) => /** @type {HTMLElement} */ (document.getElementById(id));
const filter = /** @type {HTMLInputElement} */ (element("filter"));
const branches = [.../** @type {NodeListOf<HTMLDetailsElement>} */ (document.querySelectorAll(".tree details"))];
/** @type {Map<HTMLDetailsElement, boolean> | undefined} Which were open before something was looked for. */
let before;

/** @param {Element | null | undefined} list */
const itemsOf = (list) => /** @type {HTMLElement[]} */ ([...(list?.children ?? [])]);

/**
 * Shows what fits, what is below it and what leads to it; returns whether there is anything.
 * @param {HTMLElement} item
 * @param {string} wanted
 * @param {boolean} isBelow
 * @returns {boolean}
 */
function arrange(item, wanted, isBelow) {
  const fits = item.dataset.text?.includes(wanted) ?? false;
  const branch = /** @type {HTMLDetailsElement | null} */ (item.querySelector(":scope > details"));
  const below = itemsOf(branch?.querySelector(":scope > ul"));
  const leads = below.map((child) => arrange(child, wanted, isBelow || fits)).some(Boolean);
  item.hidden = !(fits || leads || isBelow);
  if (branch) {
    branch.open = leads;
  }
  return fits || leads;
}

function look() {
  const wanted = filter.value.trim().toLowerCase();
  before ??= new Map(branches.map((branch) => [branch, branch.open]));
  const found = itemsOf(document.querySelector(".tree > ul")).map((item) => arrange(item, wanted, false));
  filter.classList.toggle("nothing", wanted !== "" && !found.some(Boolean));
  if (wanted === "") {
    for (const [branch, open] of before) {
      branch.open = open;
    }
    before = undefined;
  }
}

filter.addEventListener("input", look);
for (const id of ["open", "close"]) {
  element(id).addEventListener("click", () => {
    for (const branch of branches) {
      branch.open = id === "open";
    }
  });
}
element("theme").addEventListener("click", () => {
  const isLight = getComputedStyle(document.documentElement).getPropertyValue("--paper").trim() === "#ffffff";
  document.documentElement.dataset.theme = isLight ? "dark" : "light";
});
document.addEventListener("keydown", (event) => {
  if (event.key === "/" && event.target !== filter) {
    filter.focus();
    event.preventDefault();
  } else if (event.key === "Escape" && filter.value !== "") {
    filter.value = "";
    look();
  }
});

export {};
