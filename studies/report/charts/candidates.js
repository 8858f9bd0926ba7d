/* All candidates of a run: parallel coordinates over variables, objectives and limited responses, a scatter of any two
   of them, and a table of those that are chosen - in any figure of the page, by a press, or by a range on the axes. */
"use strict";
for (const host of document.querySelectorAll(".chart[data-kind=candidates]")) dovetail.later(host, () => {
  const {ink, text, tooltip, zoom, marks, written, united, escaped, titled} = dovetail;
  const {axes, candidates, best} = JSON.parse(host.querySelector("script").textContent);
  const states = {
    failed: {name: "not computed", role: "muted", mark: "triangle", width: 1, opacity: .35},
    broken: {name: "breaks a limit", role: "bad", mark: "cross", width: 1, opacity: .4},
    feasible: {name: "feasible", role: "after", mark: "circle", width: 1, opacity: .5},
    start: {name: "start", role: "before", mark: "triangle", width: 3, opacity: 1},
    best: {name: best, role: "one", mark: "star", width: 3, opacity: 1}};
  const order = Object.keys(states);
  const said = i => `candidate ${i + 1} (${candidates[i].phase}): ${candidates[i].status}`;
  const numbers = i => axes.map((axis, k) => `${escaped(axis.label)}: <b>${united(candidates[i].values[k], axis.unit)}</b>`).join("<br>");
  const element = (tag, into, content = "") => {
    const made = into.appendChild(document.createElement(tag));
    made.innerHTML = content;
    return made;
  };

  // What the lines mean.
  const present = order.filter(state => candidates.some(candidate => candidate.state === state));
  const legend = element("ul", host);
  legend.className = "legend";
  for (const state of present)
    element("li", legend, `<svg viewBox="0 0 24 12" aria-hidden="true"><path d="M1 6H23" style="stroke:${ink(states[state].role)}" stroke-width="${states[state].width + 1}"/></svg>${escaped(states[state].name)}`);

  // Parallel coordinates. Lines of one kind are drawn over those before it.
  const drawn = candidates.map((_, i) => i).sort((a, b) => order.indexOf(candidates[a].state) - order.indexOf(candidates[b].state));
  const wide = element("div", host);
  wide.className = "wide";
  const strip = element("div", wide);
  strip.className = "strip";
  const parallel = dovetail.open(strip, host.dataset.title);
  const broken = name => {  // in lines of about nine letters
    const lines = [""];
    for (const word of name.split(" "))
      if (lines[lines.length - 1].length + word.length > 9 && lines[lines.length - 1]) lines.push(word);
      else lines[lines.length - 1] += (lines[lines.length - 1] ? " " : "") + word;
    return lines.join("\n");
  };
  const deepest = Math.max(5, ...axes.map(axis => broken(titled(axis)).split("\n").length));
  const lines = () => drawn.map(i => {
    const look = states[candidates[i].state], chosen = dovetail.chosen();
    const shown = chosen.size === 0 || chosen.has(i);
    return {value: candidates[i].values.map(value => value === null ? "-" : value), name: said(i),
      lineStyle: {color: ink(look.role), width: look.width + (chosen.has(i) ? 1 : 0), opacity: shown ? (chosen.has(i) ? 1 : look.opacity) : .06},
      emphasis: {lineStyle: {color: ink(look.role), width: look.width + 1.5, opacity: 1}}};
  });
  parallel.setOption({animation: false, parallel: {left: 46, right: 46, top: 20 + 12 * deepest, bottom: 16, axisExpandable: false},
    tooltip: {...tooltip, trigger: "item", formatter: item => `<b>${escaped(said(drawn[item.dataIndex]))}</b><br>${numbers(drawn[item.dataIndex])}`},
    parallelAxis: axes.map((axis, dim) => ({dim, name: broken(titled(axis)), type: "value", scale: true,
      min: axis.of === "variable" ? axis.lower : undefined, max: axis.of === "variable" ? axis.upper : undefined,
      nameGap: 12, nameTruncate: {maxWidth: 200}, nameTextStyle: {...text, fontSize: 10.5, color: ink(axis.of === "variable" ? "ink" : axis.of === "objective" ? "after" : "bad"), lineHeight: 12},
      axisLine: {lineStyle: {color: ink("base")}}, axisTick: {show: false}, splitNumber: 3,
      axisLabel: {...text, fontSize: 10, formatter: value => written(value, 4), textBorderColor: ink("card"), textBorderWidth: 2},
      areaSelectStyle: {width: 16, borderWidth: 1, borderColor: ink("after"), color: ink("after"), opacity: .25}})),
    series: [{type: "parallel", data: lines(), smooth: false, animation: false, progressive: 0, inactiveOpacity: .06, activeOpacity: 1}]});
  parallel.on("axisareaselected", () => {
    const within = parallel.getModel().getSeriesByIndex(0).getRawIndicesByActiveState("active").map(k => drawn[k]);
    dovetail.choose(within.length === candidates.length ? [] : within);
  });
  parallel.on("click", item => dovetail.toggle(drawn[item.dataIndex]));

  // A scatter of any two.
  const controls = element("p", host);
  controls.className = "controls";
  const select = (label, at) => {
    const choice = element("select", element("label", controls, label + " "));
    axes.forEach((axis, i) => { element("option", choice, escaped(titled(axis))).value = i; });
    choice.value = at;
    choice.addEventListener("change", () => show());
    return choice;
  };
  const objective = axes.findIndex(axis => axis.of === "objective");
  const other = axes.findIndex((axis, i) => i !== objective && axis.of !== "variable");
  const across = select("across", other < 0 ? 0 : other), up = select("up", Math.max(objective, 0));
  const clear = element("button", controls, "choose none");
  clear.type = "button";
  clear.addEventListener("click", () => {
    axes.forEach((_, i) => parallel.dispatchAction({type: "axisAreaSelect", parallelAxisIndex: i, intervals: []}));
    dovetail.choose([]);
  });
  const field = element("div", element("div", host));
  field.className = "field";
  const scatter = dovetail.open(field, "Any two quantities of all candidates");
  const axisOf = (axis, x) => ({type: "value", scale: true, name: x ? titled(axis) : "", nameLocation: "middle", nameGap: 26,
    nameTextStyle: {...text, color: ink("ink")},
    axisLine: {show: x, onZero: false, lineStyle: {color: ink("base")}}, axisLabel: {...text, hideOverlap: true, formatter: value => written(value, 6)},
    splitLine: {lineStyle: {color: ink("hair")}}});
  const members = state => candidates.map((_, i) => i).filter(i => candidates[i].state === state);
  const cloud = () => ({animation: false, grid: {left: 4, right: 14, top: 20, bottom: 26, containLabel: true}, toolbox: zoom,
    xAxis: axisOf(axes[across.value], true), yAxis: axisOf(axes[up.value], false),
    tooltip: {...tooltip, trigger: "item", formatter: item => { const i = item.data.candidate; return `<b>${escaped(said(i))}</b><br>${numbers(i)}`; }},
    series: present.map(state => {
      const look = states[state], mark = marks[look.mark], paint = ink(look.role), chosen = dovetail.chosen();
      const style = mark.hollow ? {color: "none", borderColor: paint, borderWidth: 1.6} : {color: paint, borderColor: ink("card"), borderWidth: .8};
      return {type: "scatter", name: look.name, animation: false, ...mark, cursor: "pointer", z: order.indexOf(state) + 2,
        itemStyle: style, emphasis: {itemStyle: style},
        data: members(state).map(i => ({candidate: i, value: [candidates[i].values[across.value], candidates[i].values[up.value]],
          itemStyle: {opacity: chosen.size === 0 || chosen.has(i) ? 1 : .12}}))};
    })});
  const show = () => {
    dovetail.above(field.querySelector(".drawing-place"), axes[up.value]);
    scatter.setOption(cloud(), {replaceMerge: ["series"]});
  };
  show();
  scatter.on("click", item => dovetail.toggle(item.data.candidate));

  // The chosen ones in numbers.
  const table = element("div", host);
  table.className = "scroll chosen";
  dovetail.onChoice(chosen => {
    parallel.setOption({series: [{data: lines()}]});
    scatter.setOption(cloud());
    const rows = [...chosen].sort((a, b) => a - b).slice(0, 40).map(i => `<tr><th scope="row">${i + 1}</th><td class="text">${escaped(candidates[i].status)}</td>` +
      candidates[i].values.map(value => `<td>${written(value)}</td>`).join("") + "</tr>");
    table.innerHTML = rows.length === 0 ? "" : `<table><thead><tr><th scope="col">candidate</th><th scope="col" class="text">status</th>` +
      axes.map(axis => `<th scope="col">${escaped(titled(axis))}</th>`).join("") + `</tr></thead><tbody>${rows.join("")}</tbody></table>` +
      (chosen.size > 40 ? `<p class="soft">The first 40 of ${chosen.size} that are chosen.</p>` : "");
  });
});
