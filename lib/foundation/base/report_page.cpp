// The style and the script of a report's page.
#include "base/report_page.h"

#include "base/html_text.h"

namespace robosim {
namespace {

std::string reportStyle() {
  return "*{box-sizing:border-box}"
         ":root{color-scheme:light dark;--text:#222;--quiet:#5a6068;--line:#cfd4da;--back:#fff;--stripe:#f5f7f9;"
         "--good:#0a6b3d}"
         "@media(prefers-color-scheme:dark){:root{--text:#dfe3e8;--quiet:#9aa3ad;--line:#3b4148;--back:#15181c;"
         "--stripe:#1d2126;--good:#5fd39a}}"
         "body{font:15px/1.5 system-ui,sans-serif;margin:0 auto;max-width:100rem;padding:1.5rem;color:var(--text);"
         "background:var(--back)}"
         "h1{font-size:1.6rem;margin:0 0 .3rem}h2{margin:2.2rem 0 .6rem;font-size:1.25rem}h3{font-size:1.05rem}"
         "p{max-width:62rem}.quiet{color:var(--quiet)}"
         // Tables scroll within their box, in which the header and the first columns stay in view.
         ".wide{overflow:auto;max-height:85vh;max-width:max-content;border:1px solid var(--line)}"
         "table{border-collapse:separate;border-spacing:0;font-variant-numeric:tabular-nums}"
         "th,td{padding:.25rem .55rem;border-bottom:1px solid var(--line);text-align:right;white-space:nowrap}"
         "thead{position:sticky;top:0;z-index:2}thead th,thead td{background:var(--back);vertical-align:bottom}"
         "thead .group{text-align:center}"
         "tbody tr{background:var(--back)}tbody tr:nth-child(even){background:var(--stripe)}tbody th{font-weight:400}"
         "tbody th,.two td:nth-child(2){background:inherit}"
         "tr>:first-child,.two tr>:nth-child(2){position:sticky;left:0;z-index:1}"
         "tr>:first-child{text-align:left;white-space:normal;overflow-wrap:anywhere;width:12rem;min-width:12rem}"
         ".two tr>:nth-child(2){left:12rem}"
         "tr>:first-child,.two tr>:nth-child(2){border-right:1px solid var(--line)}"
         "@media(max-width:45rem){body{padding:.8rem}th,td{padding:.2rem .4rem;font-size:.85rem}"
         "tr>:first-child{width:7.5rem;min-width:7.5rem}.two tr>:nth-child(2){left:7.5rem}}"
         "th button{font:inherit;font-weight:600;color:inherit;background:none;border:0;padding:0;cursor:pointer;"
         "text-align:inherit}"
         "th button::after{content:' \\2195';color:var(--quiet)}"
         "th[aria-sort=ascending] button::after{content:' \\2191'}"
         "th[aria-sort=descending] button::after{content:' \\2193'}"
         "pre{background:var(--stripe);border:1px solid var(--line);border-radius:6px;padding:.8rem;overflow-x:auto;"
         "white-space:pre-wrap;overflow-wrap:anywhere}pre.columns{white-space:pre}"
         "h1,p{overflow-wrap:anywhere}"
         // Charts keep a size at which their texts can be read, and scroll on narrow pages.
         ".charts{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,36rem),1fr));gap:.5rem 1.5rem;"
         "overflow-x:auto}"
         ".chart{min-width:36rem;max-width:100%;height:auto;display:block;margin:.4rem 0}"
         "summary{cursor:pointer;font-weight:600;padding:.3rem 0}"
         ".sure{color:var(--good);font-weight:600}"
         "footer{margin-top:2.2rem;border-top:1px solid var(--line);padding-top:.6rem}"
         "@media print{.wide{max-height:none}}";
}

std::string reportScript() {
  return "for(const table of document.querySelectorAll('table')){"
         "const heads=[...table.tHead.rows].at(-1).cells;"
         "const value=(cell,column)=>{const text=cell.textContent;if(column===0)return text;"
         "const number=parseFloat(text.replace(/[<\\s]/g,''));"
         "return Number.isNaN(number)?text.startsWith('never')?Infinity:-1:number};"
         "[...heads].forEach((head,column)=>{"
         "const button=document.createElement('button');button.type='button';button.textContent=head.textContent;"
         "head.replaceChildren(button);"
         "button.addEventListener('click',()=>{"
         "const falling=head.getAttribute('aria-sort')==='ascending';"
         "for(const other of heads)other.removeAttribute('aria-sort');"
         "head.setAttribute('aria-sort',falling?'descending':'ascending');"
         "const rows=[...table.tBodies[0].rows].map(row=>[value(row.cells[column],column),row]);"
         "rows.sort(([a],[b])=>{const d=a<b?-1:a>b?1:0;return falling?-d:d});"
         "table.tBodies[0].append(...rows.map(([,row])=>row))})})}";
}

}  // namespace

std::string reportPage(const std::string& title, const std::string& content, const std::string& style) {
  const std::string heading = escapedHtml(title);
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
         "content=\"width=device-width\">\n<title>" +
         heading + "</title>\n<style>" + reportStyle() + style + "</style>\n</head>\n<body>\n<main>\n<h1>" + heading +
         "</h1>\n" + content + "</main>\n<footer class=quiet>RoboSim " ROBOSIM_VERSION ".</footer>\n<script>" +
         reportScript() + "</script>\n</body>\n</html>\n";
}

}  // namespace robosim
