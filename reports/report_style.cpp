#include "reports/report_style.h"

namespace tenku {

std::string_view report_style() {
  return R"css(
:root{--ink:#20242a;--soft:#565d65;--line:#d9dcdf;--paper:#fff;--tint:#f6f6f2;--accent:#9a3c08}
*{box-sizing:border-box}
body{margin:0;background:var(--tint);color:var(--ink);font:16px/1.55 system-ui,-apple-system,"Segoe UI","Noto Sans","Noto Sans CJK JP","Hiragino Sans",sans-serif}
main{max-width:62rem;margin:0 auto;padding:2.5rem clamp(1rem,4vw,3.5rem) 4rem;background:var(--paper)}
h1{font-size:clamp(1.7rem,4vw,2.5rem);line-height:1.15;margin:0 0 .6rem;letter-spacing:-.01em;overflow-wrap:anywhere}
h2{font-size:1.3rem;margin:2.8rem 0 .8rem;padding-top:.9rem;border-top:2px solid var(--ink)}
p{max-width:44rem;margin:.5rem 0 .9rem}
.lead{font-size:1.12rem}
.where{color:var(--soft);margin:0;max-width:none}
.figures{display:grid;grid-template-columns:repeat(auto-fit,minmax(14rem,1fr));gap:1rem;margin:1.2rem 0;padding:0}
.figure{border:1px solid var(--line);border-top:4px solid var(--accent);border-radius:4px;padding:.8rem 1rem}
.figure dt{font-size:.92rem;color:var(--soft)}
.figure dd{margin:0}
.figure .value{font-size:1.75rem;line-height:1.25;font-weight:650;font-variant-numeric:tabular-nums}
.figure .unit{font-size:1rem;font-weight:500}
.figure .interval{font-size:.92rem;font-variant-numeric:tabular-nums}
.figure .meaning{font-size:.92rem;color:var(--soft);margin-top:.35rem}
figure{margin:1.2rem 0}
figure img{display:block;width:100%;height:auto;border:1px solid var(--line)}
figure svg{display:block;width:100%;height:auto}
figure.small svg{max-width:40rem;margin:0 auto}
figcaption{font-size:.92rem;color:var(--soft);margin-top:.5rem;max-width:44rem}
.scroll{overflow-x:auto}
table{border-collapse:collapse;width:100%;font-size:.92rem;font-variant-numeric:tabular-nums}
th,td{text-align:left;padding:.45rem .7rem .45rem 0;border-bottom:1px solid var(--line);vertical-align:top}
th{font-weight:650}
thead th{border-bottom:2px solid var(--ink);vertical-align:bottom}
td.n,th.n{text-align:right}
td.id{overflow-wrap:anywhere;min-width:9rem}
.bands{display:flex;height:1.4rem;border:1px solid #4a4f55;margin:.2rem 0}
.bands span{display:block;height:100%}
.key{display:flex;flex-wrap:wrap;gap:.3rem 1.2rem;list-style:none;padding:0;margin:.9rem 0;font-size:.92rem}
.key i{display:inline-block;width:1em;height:1em;margin-right:.4em;vertical-align:-.12em;border:1px solid #4a4f55}
.severity{font-weight:650;white-space:nowrap}
.severity.error{color:#9b1c1c}.severity.warning{color:#8a4b00}.severity.note{color:#2f5673}
footer{margin-top:3rem;padding-top:.8rem;border-top:1px solid var(--line);font-size:.88rem;color:var(--soft)}
@media print{
@page{size:A4;margin:16mm 15mm}
body{background:#fff;font-size:10pt}
main{max-width:none;padding:0}
h2{break-after:avoid;margin-top:1.6rem}
figure,.figure,tr{break-inside:avoid}
.figures{grid-template-columns:repeat(3,1fr)}
.scroll{overflow:visible}
*{-webkit-print-color-adjust:exact;print-color-adjust:exact}
}
)css";
}

}  // namespace tenku
