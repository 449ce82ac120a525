// SPDX-License-Identifier: BSD-3-Clause
// Sorts a table by the column whose title is clicked, up and then down; cells without a value stay last.
"use strict";

for (const table of document.querySelectorAll("table.sortable")) {
  const titles = [...table.tHead.rows[0].cells];
  titles.forEach((title, column) => {
    const numeric = title.classList.contains("number");
    const button = document.createElement("button");
    button.textContent = title.textContent;
    title.replaceChildren(button);
    button.addEventListener("click", () => {
      const up = title.getAttribute("aria-sort") !== "ascending";
      titles.forEach((other) => other.removeAttribute("aria-sort"));
      title.setAttribute("aria-sort", up ? "ascending" : "descending");
      const value = (row) => row.cells[column].textContent;
      const missing = (text) => (numeric ? Number.isNaN(parseFloat(text)) : text === "");
      const order = (a, b) => (numeric ? parseFloat(a) - parseFloat(b) : a.localeCompare(b));
      const rows = [...table.tBodies[0].rows].sort((one, two) => {
        const a = value(one), b = value(two);
        if (missing(a) || missing(b)) return missing(a) - missing(b);
        return up ? order(a, b) : order(b, a);
      });
      table.tBodies[0].append(...rows);
    });
  });
}
