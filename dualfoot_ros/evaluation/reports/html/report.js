"use strict";
// A report: all of its numbers are in the page.
(() => {
  const { tables, charts, range, padded } = plots;
  const page = JSON.parse(document.getElementById("data").textContent);

  // ---- columns: whole numbers, each the difference to the one before ----------------------------
  for (const [name, columns] of Object.entries(page.tables)) {
    tables[name] = {};
    for (const [key, column] of Object.entries(columns)) {
      let sum = 0;
      tables[name][key] = Float64Array.from(column.d, (d) =>
        d === null ? NaN : (sum += d) * column.unit);
    }
  }

  for (const figure of document.querySelectorAll("figure.plot")) {
    plots.add(figure, page.charts[figure.dataset.plot]);
  }
  // Plots over the same abscissa begin and end alike.
  for (const chart of charts) {
    if (chart.equal) continue;
    const alike = charts.filter((c) => !c.equal && c.spec.group === chart.spec.group);
    chart.common = padded(range(alike.map((c) => c.full.x)), 0.01);
  }
  for (const chart of charts) {
    if (chart.common) chart.full.x = chart.common;
    chart.reset();
  }
  document.documentElement.dataset.ready = String(charts.length);
})();
