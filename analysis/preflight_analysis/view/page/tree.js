// The page of `ros-preflight tree --format html`: a filter, and all branches opened or closed at once.

(() => {
  const element = (id) => document.getElementById(id);
  const filter = element("filter");
  const top = document.querySelector(".tree > ul");
  const branches = [...document.querySelectorAll(".tree details")];
  let before;

  const branchOf = (item) => item.querySelector(":scope > details");
  const below = (item) => [...(branchOf(item)?.querySelector(":scope > ul")?.children ?? [])];

  /** Shows what fits, what is below it and what leads to it; returns whether there is anything. */
  function arrange(item, wanted, isBelow) {
    const fits = item.dataset.text.includes(wanted);
    const inside = below(item).map((child) => arrange(child, wanted, isBelow || fits));
    const leads = inside.some(Boolean);
    item.hidden = !(fits || leads || isBelow);
    const branch = branchOf(item);
    if (branch) {
      branch.open = leads;
    }
    return fits || leads;
  }

  function look() {
    const wanted = filter.value.trim().toLowerCase();
    before ??= new Map(branches.map((branch) => [branch, branch.open]));
    const found = [...(top?.children ?? [])].map((item) => arrange(item, wanted, false));
    filter.classList.toggle("nothing", wanted !== "" && !found.some(Boolean));
    if (wanted === "") {
      before.forEach((open, branch) => (branch.open = open));
      before = undefined;
    }
  }

  filter.addEventListener("input", look);
  for (const id of ["open", "close"]) {
    element(id).addEventListener("click", () => branches.forEach((branch) => (branch.open = id === "open")));
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
})();
