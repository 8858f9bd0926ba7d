/* Draws the figures of a page from their data with ECharts: axes in the words and units of the data, a legend that
   hides and shows, values of what is pointed at, zoom. Colours are those of the style sheet, so light, dark and paper
   need no other drawing. Candidates chosen in one figure are shown in all. */
"use strict";
const dovetail = (() => {
  const ink = name => `var(--${name})`;
  const strokes = {solid: "solid", dashed: [6, 4], dotted: [1.5, 4]};
  const marks = {
    dot: {symbol: "circle", symbolSize: 4}, circle: {symbol: "circle", symbolSize: 7},
    cross: {symbol: "path://M0 0L8 8M8 0L0 8", symbolSize: 7, hollow: true}, triangle: {symbol: "triangle", symbolSize: 9},
    star: {symbol: "path://M10 0L12.9 6.6L20 7.3L14.7 12L16.2 19L10 15.4L3.8 19L5.3 12L0 7.3L7.1 6.6Z", symbolSize: 16}};
  const scale = ["#fdf6da", "#fccf82", "#f39254", "#d65456", "#922b62", "#3e134b"];  // light to dark in even steps

  const escaped = text => String(text).replace(/[&<>"]/g, c => ({"&": "&amp;", "<": "&lt;", ">": "&gt;", '"': "&quot;"}[c]));
  const raised = n => String(n).replace(/[-0-9]/g, c => c === "-" ? "\u207b" : "\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079"[c]);

  /* A number as engineers write it. */
  function written(value, digits = 4) {
    if (value === null || value === undefined || !isFinite(value)) return "\u2013";
    const size = Math.abs(value);
    let text;
    if (size > 0 && (size < 1e-4 || size >= 1e6)) {
      const power = Math.floor(Math.log10(size) + 1e-12), lead = +(size / 10 ** power).toPrecision(digits);
      text = (lead === 1 ? "" : lead + "\u00d7") + "10" + raised(power);
    } else {
      text = String(+size.toPrecision(digits));
    }
    return (value < 0 ? "\u2212" : "") + text;
  }
  const united = (value, unit, digits) => written(value, digits) + (unit ? "\u00a0" + unit : "");
  const titled = axis => axis.label + (axis.unit ? ` (${axis.unit})` : "");

  const charts = [];                // {chart, host, redraw}
  let chosen = new Set();           // candidates
  const listeners = [];             // told when they change

  const text = {color: ink("soft"), fontSize: 12, fontFamily: "system-ui,-apple-system,'Segoe UI',Roboto,sans-serif"};
  const tooltip = {confine: true, backgroundColor: ink("card"), borderColor: ink("hair"), padding: [6, 9],
    textStyle: {...text, color: ink("ink")}, transitionDuration: 0, extraCssText: "max-width:22rem;white-space:normal"};
  const zoom = {show: true, right: 0, top: -6, itemSize: 12, itemGap: 6, iconStyle: {borderColor: ink("base")},
    emphasis: {iconStyle: {borderColor: ink("after")}},
    feature: {dataZoom: {title: {zoom: "zoom: draw a frame", back: "zoom back"}, filterMode: "none",
      brushStyle: {color: ink("wash"), opacity: .5, borderColor: ink("after")}}}};

  /* What stands upwards, in a line of its own above the drawing. */
  function above(place, axis) {
    let line = place.previousElementSibling;
    if (!line || line.className !== "upwards") {
      line = document.createElement("div");
      line.className = "upwards";
      place.before(line);
    }
    line.textContent = titled(axis);
  }

  /* @param room  beside the outermost values across, of their range: marks would be cut there, lines are not */
  function axisOption(axis, across, room = 0, ends = []) {
    const beside = range => range.max > range.min ? room * (range.max - range.min) : .1 * Math.abs(range.max) || 1;
    // A logarithmic axis that is tight ends at 1, 2 or 5 times a power of ten.
    const round = (value, up) => {
      const power = 10 ** Math.floor(Math.log10(value) + 1e-9), leads = up ? [1, 2, 5, 10] : [5, 2, 1];
      return power * leads.find(lead => up ? lead * power >= value * (1 - 1e-9) : lead * power <= value * (1 + 1e-9));
    };
    const plain = end => axis.whole || axis.log || !across || (room === 0 && +Number(end).toPrecision(2) === end) ? undefined : false;
    return {
      type: axis.log ? "log" : "value", scale: !axis.zero, name: across ? titled(axis) : "",
      nameLocation: "middle", nameGap: 26, nameTextStyle: {...text, color: ink("ink")},
      min: axis.range ? axis.range[0] : across && (axis.log ? axis.tight : !axis.zero) ? range => axis.log ? round(range.min, false) : range.min - beside(range) : undefined,
      max: axis.range ? axis.range[1] : across && (!axis.log || axis.tight) ? range => axis.log ? round(range.max, true) : range.max + beside(range) : undefined,
      minInterval: axis.whole ? 1 : undefined, splitNumber: across ? 5 : 4,
      axisLine: {show: across, onZero: false, lineStyle: {color: ink("base")}}, axisTick: {show: across, lineStyle: {color: ink("base")}},
      axisLabel: {...text, hideOverlap: true, showMinLabel: plain(ends[0]), showMaxLabel: plain(ends[1]), alignMaxLabel: across && axis.log ? "right" : null,
        formatter: value => written(value, axis.log ? 2 : 6)},
      splitLine: {show: !across, lineStyle: {color: ink("hair")}}, minorTick: {show: false}, axisPointer: {label: {show: false}}};
  }

  const colour = series => series.shade === undefined ? ink(series.role)
    : `color-mix(in oklch, ${ink("after")} ${Math.round(100 * series.shade)}%, ${ink("three")})`;

  function told(plot, series, index) {
    if (series.titles && series.titles[index]) return escaped(series.titles[index]).replace(/\n/g, "<br>");
    const [x, y] = series.points[index];
    return `${escaped(series.name)}<br>${escaped(plot.x.label)}: ${united(x, plot.x.unit)}<br>` +
      `${escaped(plot.y.label)}: <b>${united(y, plot.y.unit)}</b>`;
  }

  function seriesOption(plot, series) {
    const line = series.stroke !== "none", mark = marks[series.mark] || {}, paint = colour(series);
    const fading = series.candidates && chosen.size > 0;
    const style = mark.hollow ? {color: "none", borderColor: paint, borderWidth: 1.6}
      : {color: paint, borderColor: ink("card"), borderWidth: series.mark === "dot" ? 0 : .8};
    return {
      type: line ? "line" : "scatter", name: series.name || plot.y.label, animation: false, step: series.steps ? "end" : false,
      data: series.points.map((point, i) => {
        const value = point || [null, null];
        if (!fading && !series.labels) return value;
        const item = {value};
        if (fading) item.itemStyle = {opacity: chosen.has(series.candidates[i]) ? 1 : .12};
        if (series.labels) item.label = {show: !!series.labels[i], formatter: () => series.labels[i]};
        return item;
      }),
      ...mark, showSymbol: line && series.mark !== "none", symbol: mark.symbol || "circle", symbolSize: mark.symbolSize || 0,
      itemStyle: style, lineStyle: {color: paint, width: 2, type: strokes[series.stroke] || "solid"},
      label: {...text, fontSize: 11, position: "right", color: ink("soft")}, labelLayout: {hideOverlap: true},
      emphasis: {disabled: line, scale: 1.5, itemStyle: style}, cursor: series.candidates ? "pointer" : "default",
      z: series.mark === "star" ? 5 : series.mark === "none" || line ? 2 : 3};
  }

  function plotOption(plot, hidden = () => false) {
    const lines = plot.series.every(series => series.stroke !== "none" || series.points.length === 0);
    const series = plot.series.map(one => seriesOption(plot, one));
    const places = plot.series.flatMap(one => one.points.filter(point => point).map(point => point[0]));
    const levels = plot.levels || [];  // with a point that cannot be seen on each, for the range of the axis
    if (levels.length) series.push({type: "scatter", data: levels.map(level => [places[0], level.y]), symbolSize: 0, silent: true,
      tooltip: {show: false}, markLine: {symbol: "none", silent: true, animation: false, label: {show: false},
        lineStyle: {color: ink("bad"), type: [2, 3], width: 1.2}, data: levels.map(level => ({yAxis: level.y}))}});
    if (plot.shaded_below) series.push({type: "line", data: [], silent: true, markArea: {silent: true, animation: false,
      itemStyle: {color: ink("hair"), opacity: .6}, data: [[{yAxis: "min"}, {yAxis: plot.shaded_below}]]}});
    const marked = plot.series.some(one => one.stroke === "none" && one.points.length > 0);
    const x = axisOption(plot.x, true, marked && !plot.x.whole ? .03 : 0, [Math.min(...places), Math.max(...places)]);
    return {animation: false, grid: {left: 4, right: 14, top: 20, bottom: 26, containLabel: true}, xAxis: x,
      yAxis: axisOption(plot.y, false), toolbox: zoom, series, tooltip: lines ? {...tooltip, trigger: "axis", formatter: items => along(plot, items[0].axisValue, hidden),
        axisPointer: {type: "line", lineStyle: {color: ink("base")}}}
        : {...tooltip, trigger: "item", formatter: item => told(plot, plot.series[item.seriesIndex], item.dataIndex)}};
  }

  /* What the lines that are not hidden come to where the pointer is, between their points too. */
  function along(plot, at, hidden) {
    const rows = plot.series.filter(series => !hidden(series.name || plot.y.label)).map(series => {
      const value = between(series, at, plot);
      return value === null ? "" : `<br><i style="background:${colour(series)}"></i>${escaped(series.name || plot.y.label)}: <b>${united(value, plot.y.unit)}</b>`;
    });
    return `${escaped(plot.x.label)}: ${united(at, plot.x.unit)}` + rows.join("");
  }
  function between(series, at, plot) {
    for (let i = 0; i + 1 < series.points.length; ++i) {
      if (!series.points[i] || !series.points[i + 1]) continue;
      const [[x0, y0], [x1, y1]] = [series.points[i], series.points[i + 1]];
      if ((at - x0) * (at - x1) > 0) continue;
      if (series.steps) return at === x1 ? y1 : y0;
      const t = x1 === x0 ? 0 : plot.x.log ? Math.log(at / x0) / Math.log(x1 / x0) : (at - x0) / (x1 - x0);
      return plot.y.log ? y0 * (y1 / y0) ** t : y0 + t * (y1 - y0);
    }
    return null;
  }

  function mapOption(map) {
    const count = map.panels.length, small = {...text, fontSize: 11};
    const option = {animation: false, tooltip: {...tooltip, formatter: ({value}) =>
      `along the slot ${united(value[0], "mm", 3)}<br>from the neck side ${united(value[1], "mm", 3)}<br>` +
      `${escaped(map.quantity)} <b>${united(value[6], map.unit)}</b>`},
      visualMap: {type: "continuous", dimension: 6, min: 0, max: map.most || 1, inRange: {color: scale}, calculable: false, precision: 2,
        right: 0, top: "middle", itemHeight: 110, itemWidth: 11, text: [`${written(map.most, 3)} ${map.unit}`, "0"], textStyle: small, formatter: value => united(value, map.unit, 3)},
      title: [], grid: [], xAxis: [], yAxis: [], series: []};
    map.panels.forEach((panel, i) => {
      const left = 12 + i * 75 / count, width = 75 / count - 7;
      const reach = (a, b) => [Math.min(...panel.cells.map(c => c[a])), Math.max(...panel.cells.map(c => c[b]))];
      const [[x0, x1], [y0, y1]] = [reach(2, 3), reach(4, 5)];
      option.grid.push({left: left + "%", width: width + "%", top: 34, bottom: 44});
      option.title.push({text: panel.name, left: left + "%", top: 8, textStyle: {...text, fontWeight: "normal"}, padding: 0});
      const axis = {type: "value", gridIndex: i, axisLabel: {...small, hideOverlap: true, showMinLabel: false, showMaxLabel: false, formatter: v => written(v, 4)},
        splitLine: {show: false}, axisLine: {show: false}, nameLocation: "middle", nameTextStyle: {...small, color: ink("ink")}};
      option.xAxis.push({...axis, min: x0, max: x1, name: "along the slot (mm)", nameGap: 24, splitNumber: 3});
      option.yAxis.push({...axis, min: y0, max: y1, name: i ? "" : "from the neck side (mm)", nameGap: 22, inverse: true, splitNumber: 4});
      option.series.push({type: "custom", xAxisIndex: i, yAxisIndex: i, data: panel.cells, encode: {x: 0, y: 1}, animation: false,
        renderItem: (_, api) => {
          const [ax, ay] = api.coord([api.value(2), api.value(4)]), [bx, by] = api.coord([api.value(3), api.value(5)]);
          return {type: "rect", shape: {x: Math.min(ax, bx), y: Math.min(ay, by), width: Math.abs(bx - ax), height: Math.abs(by - ay)},
            style: {fill: isFinite(api.value(6)) ? api.visual("color") : ink("hair"), stroke: isFinite(api.value(6)) ? api.visual("color") : ink("hair"), lineWidth: .6}};
        }});
    });
    return option;
  }

  /* Names of the series beside what they look like; a press hides or shows one. */
  function legend(host, plot, chart) {
    const list = document.createElement("ul");
    list.className = "legend";
    const add = (name, swatch, index) => {
      const item = list.appendChild(document.createElement("li"));
      item.innerHTML = swatch + escaped(name);
      if (index === undefined) return;
      item.tabIndex = 0;
      item.setAttribute("role", "switch");
      item.setAttribute("aria-checked", "true");
      const press = () => {
        item.setAttribute("aria-checked", item.getAttribute("aria-checked") !== "true");
        chart.dispatchAction({type: "legendToggleSelect", name});
      };
      item.addEventListener("click", press);
      item.addEventListener("keydown", event => { if (event.key === "Enter" || event.key === " ") { event.preventDefault(); press(); } });
    };
    const line = (paint, stroke) => `<svg viewBox="0 0 24 12" aria-hidden="true"><path d="M1 6H23" fill="none" style="stroke:${paint}" stroke-width="2" stroke-dasharray="${strokes[stroke] === "solid" ? "none" : strokes[stroke]}"/></svg>`;
    const signs = {dot: "\u2022", circle: "\u25cf", cross: "\u2715", triangle: "\u25b2", star: "\u2605"};
    plot.series.forEach((series, i) => {
      if (!series.name || series.points.length === 0) return;
      add(series.name, series.stroke !== "none" ? line(colour(series), series.stroke)
        : `<b aria-hidden="true" style="color:${colour(series)}">${signs[series.mark] || ""}</b>`, i);
    });
    for (const level of plot.levels || []) if (level.name) add(level.name, line(ink("bad"), "dotted"));
    if (list.children.length) host.before(list);
  }

  function draw(host) {
    const data = JSON.parse(host.querySelector("script").textContent);
    const kind = host.dataset.kind, chart = open(host, host.dataset.title);
    if (kind === "map") {
      chart.setOption(mapOption(data));
    } else {
      const hidden = name => chart.getOption().legend[0].selected[name] === false;
      chart.setOption({...plotOption(data, hidden), legend: {show: false}});
      legend(host, data, chart);
      above(host.querySelector(".drawing-place"), data.y);
      if (data.series.some(series => series.candidates)) {
        chart.on("click", item => {
          const series = data.series[item.seriesIndex];
          if (series && series.candidates) toggle(series.candidates[item.dataIndex]);
        });
        listeners.push(() => chart.setOption({series: plotOption(data).series}));
      }
    }
  }

  /* A chart in a place of the page. */
  function open(host, title) {
    const place = host.appendChild(document.createElement("div"));
    place.className = "drawing-place";
    place.setAttribute("role", "img");
    place.setAttribute("aria-label", title);
    const chart = echarts.init(place, null, {renderer: "svg"});
    charts.push({chart, host, place});
    return chart;
  }

  function choose(candidates) {
    chosen = new Set(candidates);
    listeners.forEach(listener => listener(chosen));
  }
  function toggle(candidate) {
    const next = new Set(chosen);
    if (!next.delete(candidate)) next.add(candidate);
    choose(next);
  }

  function tools(chart, show) { if (chart.getOption().toolbox) chart.setOption({toolbox: {show}}); }
  let printing = false;
  function fit() {  // only what has another width
    if (!printing) charts.forEach(({chart, place}) => { if (chart.getWidth() !== place.clientWidth && place.clientWidth > 0) chart.resize({width: "auto", height: "auto"}); });
  }
  /* Paper is two or three columns of figures wide, whatever the window is. */
  function onPaper() {
    while (waiting.length) next();
    printing = true;
    charts.forEach(({chart, host, place}) => {
      const [width, height] = place.closest(".wide,.field") ? [660, 225] : host.dataset.kind === "map" ? [305, 185] : place.closest(".small") ? [195, 130] : [305, 150];
      chart.resize({width, height});
      tools(chart, false);
      chart.getZr().flush();  // paper does not wait for the next frame
    });
  }

  /* What stands on the first screen is drawn at once, the rest one by one behind it, or when it is to be printed. */
  const waiting = [];
  function later(host, task) {
    if (host.getBoundingClientRect().top < innerHeight) task();
    else waiting.push(task);
  }
  function next() { if (waiting.length) waiting.shift()(); }
  const ready = new Promise(done => addEventListener("load", function step() {
    next();
    if (waiting.length) setTimeout(step);
    else done();
  }));

  function start() {
    document.querySelectorAll(".chart[data-kind=plot],.chart[data-kind=map]").forEach(host => later(host, () => draw(host)));
    let frame = 0;
    new ResizeObserver(() => { cancelAnimationFrame(frame); frame = requestAnimationFrame(fit); }).observe(document.body);
    addEventListener("beforeprint", onPaper);
    addEventListener("afterprint", () => { printing = false; fit(); charts.forEach(({chart}) => tools(chart, true)); });
  }

  return {start, later, ready, open, above, choose, toggle, onPaper, written, united, escaped, titled, ink, text, tooltip, zoom, marks, chosen: () => chosen,
    onChoice: listener => listeners.push(listener)};
})();
dovetail.start();
