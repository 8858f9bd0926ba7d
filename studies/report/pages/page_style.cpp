#include "studies/report/pages/page_style.hpp"

#include "studies/report/pages/html.hpp"
#include "studies/report/plots/svg_plot.hpp"

namespace dovetail::report {

namespace {

/// Rules for text, tables and figures; the colours are those of plot_style().
std::string page_style() {
  return R"(
*{box-sizing:border-box}
body{margin:0;background:var(--paper);color:var(--ink);font:16px/1.5 system-ui,-apple-system,"Segoe UI",Roboto,sans-serif}
main{max-width:1120px;margin:0 auto;padding:2.2rem 1.4rem 4rem}
h1{font-size:1.1rem;font-weight:600;color:var(--soft);margin:0 0 .5rem}
.lead{font-size:1.5rem;line-height:1.32;font-weight:600;margin:0 0 .7rem;max-width:52rem;text-wrap:pretty}
h2{font-size:1.2rem;margin:2.6rem 0 .8rem;padding-top:1.1rem;border-top:1px solid var(--hair)}
h3{font-size:1rem;margin:0 0 .35rem}h3.above{margin-top:1.6rem}.grid2+.grid2{margin-top:1.1rem}ul+.grid2,.scroll+.grid2{margin-top:1rem}p{margin:.4rem 0;max-width:52rem}ul{padding-left:1.2rem;margin:.4rem 0}
.soft,figcaption,td .soft{color:var(--soft)}figcaption{font-size:.86rem;margin-top:.3rem;max-width:52rem}figure>details{margin-top:auto;padding-top:.5rem}
.grid2{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,28rem),1fr));gap:1.1rem}
.shape{display:grid;grid-template-columns:minmax(0,3.3fr) minmax(0,1fr);gap:1.1rem;align-items:stretch}
figure{margin:0;display:flex;flex-direction:column;background:var(--card);border:1px solid var(--hair);border-radius:8px;padding:1rem 1.1rem .8rem;min-width:0}
figure.nothing p{color:var(--soft)}
.scroll{overflow-x:auto;-webkit-overflow-scrolling:touch}
table{border-collapse:collapse;font-size:.92rem;font-variant-numeric:tabular-nums}
th,td{padding:.32rem .9rem .32rem 0;text-align:right;border-bottom:1px solid var(--hair);white-space:nowrap;font-weight:400}
thead th{color:var(--soft);font-size:.84rem;vertical-align:bottom}tbody th,th:first-child,td.text,th.text{text-align:left}
table.pair{width:100%}table.figures tbody th::first-letter{text-transform:uppercase}
tr.aim th,tr.aim td{font-weight:600}tr.aim th{color:var(--after)}tr.soft td{color:var(--soft)}
.flag{color:var(--bad);font-size:.84rem}code,pre{font:.84rem/1.5 ui-monospace,"DejaVu Sans Mono",Menlo,monospace}
pre{overflow-x:auto;background:var(--card);border:1px solid var(--hair);border-radius:8px;padding:.9rem;margin:.6rem 0}
details{margin:.6rem 0 0}summary{cursor:pointer;color:var(--soft);font-size:.86rem}details table{margin-top:.5rem}
details.numbers .scroll{max-height:18rem;overflow-y:auto}
dl{display:grid;grid-template-columns:max-content 1fr;gap:.2rem 1.2rem;margin:.4rem 0}dt{color:var(--soft)}dd{margin:0;overflow-wrap:anywhere}
svg.drawing{display:block;width:100%;height:auto;max-height:32rem}
.sector svg.drawing{max-height:26rem}
.blade,.disk,.ghost,.form,.bar{vector-effect:non-scaling-stroke;stroke-linejoin:round}
.blade{fill:var(--wash);stroke:var(--after);stroke-width:1.6}.disk{fill:var(--steel);stroke:var(--base);stroke-width:1.2}
.ghost{fill:none;stroke:var(--before);stroke-width:1}.form{fill:var(--after);fill-opacity:.55;stroke:none}
.bar{fill:none;stroke:var(--soft);stroke-width:1.2}svg.drawing text{fill:var(--soft);font-family:system-ui,sans-serif}
ul.legend .blade,ul.legend .disk{stroke-width:1}
@media(max-width:640px){svg.plot text{font-size:15px}
table.pair,table.pair tbody{display:block}table.pair thead{display:none}
table.pair tr{display:grid;grid-template-columns:1fr 1fr;gap:0 .6rem;padding:.35rem 0;border-bottom:1px solid var(--hair)}
table.pair th,table.pair td{border:0;padding:0;text-align:left;white-space:normal}
table.pair td:nth-child(2){grid-area:2/1}table.pair td:nth-child(3){grid-area:2/2}table.pair td:nth-child(4){grid-area:1/2;text-align:right}
table.pair td:nth-child(2)::before{content:"before ";color:var(--soft);font-weight:400}
table.pair td:nth-child(3)::before{content:"after ";color:var(--soft);font-weight:400}
main{padding:1.3rem .9rem 3rem}.lead{font-size:1.2rem}.shape{grid-template-columns:1fr}
.sector svg.drawing{max-height:20rem}figure{padding:.8rem .7rem .6rem}dl{grid-template-columns:1fr}dd{margin-bottom:.4rem}}
@media print{figure,table{break-inside:avoid}details.numbers{display:none}}
)";
}

}  // namespace

std::string page_begin(const std::string& title, const std::string& rules) {
  return "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"/>\n"
         "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\"/>\n<title>" +
         escape(title) + "</title>\n<style>" + plot_style() + page_style() + rules + "</style></head>\n<body><main>\n";
}

}  // namespace dovetail::report
