#include "reports/mesh_page.h"

#include "output/image_writer.h"
#include "reports/html.h"
#include "reports/report_style.h"

namespace tenku {
namespace {

constexpr std::string_view kColumns =
    ".meshes{display:grid;grid-auto-flow:column;grid-auto-columns:1fr;gap:1rem}"
    ".meshes h2{min-height:5rem}"
    ".meshes img{width:100%;display:block;margin:0 0 .6rem}"
    ".meshes dl{display:grid;grid-template-columns:auto auto;gap:.1rem 1rem;font-size:.85rem}"
    ".meshes dd{margin:0;text-align:right}body{max-width:100rem}";

std::string picture(const Image8& image, const std::string& what) {
  return "<img alt=\"" + escaped(what) + "\" src=\"data:image/png;base64," +
         base64(png_bytes(image)) + "\">\n";
}

}  // namespace

std::string mesh_page(const std::string& title, const std::vector<MeshPageColumn>& columns) {
  std::string page = "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" +
                     escaped(title) + "</title>\n<style>" + std::string(report_style()) +
                     std::string(kColumns) + "</style></head>\n<body><main><h1>" + escaped(title) +
                     "</h1>\n<div class=\"meshes\">\n";
  for (const MeshPageColumn& column : columns) {
    page += "<section><h2>" + escaped(column.title) + "</h2>\n";
    page += picture(column.pictures.mesh, "Elements: " + column.title);
    page += picture(column.pictures.shaded, "Light: " + column.title);
    page += "<dl>";
    for (const auto& [name, value] : column.facts) {
      page += "<dt>" + escaped(name) + "</dt><dd>" + escaped(value) + "</dd>";
    }
    page += "</dl></section>\n";
  }
  return page + "</div></main></body></html>\n";
}

}  // namespace tenku
