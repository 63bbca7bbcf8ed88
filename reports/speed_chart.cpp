#include "reports/speed_chart.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "core/version.h"
#include "output/canvas.h"
#include "reports/html.h"
#include "reports/report_style.h"
#include "view/value_scale.h"

namespace tenku {
namespace {

constexpr double kWidth = 900.0, kHeight = 480.0;  // user units, and pixels of the picture
constexpr double kLeft = 78.0, kRight = 230.0, kTop = 44.0, kBottom = 58.0;
constexpr double kMark = 5.0;
constexpr double kLeastTime_s = 1e-4, kLeastError = 1e-3;  // what is less is drawn there

// Distinct for most eyes, and in grey: after M. Okabe and K. Ito, "Color Universal Design", 2008.
constexpr std::array<Rgb8, 8> kColours{Rgb8{0, 114, 178},   Rgb8{213, 94, 0},   Rgb8{0, 158, 115},
                                       Rgb8{204, 121, 167}, Rgb8{86, 180, 233}, Rgb8{230, 159, 0},
                                       Rgb8{110, 110, 110}, Rgb8{150, 60, 20}};

std::string hex(Rgb8 c) {
  constexpr std::string_view kDigits = "0123456789abcdef";
  std::string text = "#";
  for (const std::uint8_t v : {c.r, c.g, c.b}) {
    text += kDigits[v / 16];
    text += kDigits[v % 16];
  }
  return text;
}

/// Where things lie on a chart.
class Layout {
 public:
  explicit Layout(const SpeedChart& chart) {
    std::vector<double> times, errors;
    for (const SpeedMark& m : chart.marks) {
      times.push_back(std::max(m.time_s, kLeastTime_s));
      errors.push_back(std::max(m.error_pct, kLeastError));
      if (std::find(lines_.begin(), lines_.end(), m.line) == lines_.end()) lines_.push_back(m.line);
    }
    if (chart.floor_pct > kLeastError) errors.push_back(chart.floor_pct);
    time_ = around(times);
    error_ = around(errors);
  }

  PixelPosition at(double time_s, double error_pct) const {
    return {kLeft + time_.position_of(std::max(time_s, kLeastTime_s)) * (kWidth - kLeft - kRight),
            kHeight - kBottom -
                error_.position_of(std::max(error_pct, kLeastError)) * (kHeight - kTop - kBottom)};
  }
  PixelPosition at(const SpeedMark& m) const { return at(m.time_s, m.error_pct); }
  const ValueScale& time() const { return time_; }
  const ValueScale& error() const { return error_; }
  const std::vector<std::string>& lines() const { return lines_; }
  Rgb8 colour(const std::string& line) const {
    const auto at = std::find(lines_.begin(), lines_.end(), line) - lines_.begin();
    return kColours[static_cast<std::size_t>(at) % kColours.size()];
  }

 private:
  static ValueScale around(const std::vector<double>& values) {
    ValueScale scale{1.0, 10.0, true};
    if (values.empty()) return scale;
    const auto [low, high] = std::minmax_element(values.begin(), values.end());
    scale.low = *low / 1.3;
    scale.high = *high * 1.3;
    return scale;
  }

  ValueScale time_, error_;
  std::vector<std::string> lines_;
};

std::vector<const SpeedMark*> sorted_marks(const SpeedChart& chart, const std::string& line) {
  std::vector<const SpeedMark*> marks;
  for (const SpeedMark& m : chart.marks) {
    if (m.line == line) marks.push_back(&m);
  }
  std::stable_sort(marks.begin(), marks.end(),
                   [](const SpeedMark* a, const SpeedMark* b) { return a->time_s < b->time_s; });
  return marks;
}

std::vector<const SpeedMark*> front_of(const SpeedChart& chart) {
  std::vector<const SpeedMark*> marks;
  for (const SpeedMark& m : chart.marks) {
    if (m.is_on_front) marks.push_back(&m);
  }
  std::sort(marks.begin(), marks.end(),
            [](const SpeedMark* a, const SpeedMark* b) { return a->time_s < b->time_s; });
  return marks;
}

/// What a chart is drawn on: a page or a picture.
class Pen {
 public:
  virtual ~Pen() = default;
  virtual void line(const std::vector<PixelPosition>& points, const LineStyle& style) = 0;
  virtual void box(PixelPosition from, PixelPosition to, Rgb8 colour) = 0;
  virtual void text(PixelPosition place, const std::string& text, const TextStyle& style) = 0;
  virtual void disc(PixelPosition place, double radius, Rgb8 colour, const std::string& tip) = 0;
  virtual void ring(PixelPosition place, double radius) = 0;
};

class SvgPen : public Pen {
 public:
  void line(const std::vector<PixelPosition>& points, const LineStyle& style) override {
    svg += "<polyline fill=\"none\" stroke=\"" + hex(style.colour) + "\" stroke-width=\"" +
           coordinate(style.width) + "\" stroke-opacity=\"" + coordinate(style.opacity) +
           "\" points=\"";
    for (const PixelPosition& p : points) svg += coordinate(p.x) + "," + coordinate(p.y) + " ";
    svg += "\"/>\n";
  }
  void box(PixelPosition from, PixelPosition to, Rgb8 colour) override {
    svg += "<rect x=\"" + coordinate(from.x) + "\" y=\"" + coordinate(from.y) + "\" width=\"" +
           coordinate(to.x - from.x) + "\" height=\"" + coordinate(to.y - from.y) + "\" fill=\"" +
           hex(colour) + "\"/>\n";
  }
  void text(PixelPosition place, const std::string& words, const TextStyle& style) override {
    const char* anchor = style.align == TextAlign::Left    ? "start"
                         : style.align == TextAlign::Right ? "end"
                                                           : "middle";
    svg += "<text x=\"" + coordinate(place.x) + "\" y=\"" + coordinate(place.y) +
           "\" font-size=\"" + coordinate(style.size) + "\" text-anchor=\"" + anchor +
           "\" fill=\"" + hex(style.colour) + "\"" + (style.bold ? " font-weight=\"650\"" : "") +
           ">" + escaped(words) + "</text>\n";
  }
  void disc(PixelPosition place, double radius, Rgb8 colour, const std::string& tip) override {
    svg += "<circle cx=\"" + coordinate(place.x) + "\" cy=\"" + coordinate(place.y) + "\" r=\"" +
           coordinate(radius) + "\" fill=\"" + hex(colour) + "\">" +
           (tip.empty() ? "" : "<title>" + escaped(tip) + "</title>") + "</circle>\n";
  }
  void ring(PixelPosition place, double radius) override {
    svg += "<circle cx=\"" + coordinate(place.x) + "\" cy=\"" + coordinate(place.y) + "\" r=\"" +
           coordinate(radius) + "\" fill=\"none\" stroke=\"#20242a\" stroke-width=\"2\"/>\n";
  }

  std::string svg;
};

class CanvasPen : public Pen {
 public:
  CanvasPen(Canvas& canvas, double down) : canvas_(canvas), down_(down) {}
  void line(const std::vector<PixelPosition>& points, const LineStyle& style) override {
    std::vector<PixelPosition> moved;
    for (const PixelPosition& p : points) moved.push_back(move(p));
    canvas_.line(moved, style);
  }
  void box(PixelPosition from, PixelPosition to, Rgb8 colour) override {
    canvas_.fill_box(move(from), move(to), colour);
  }
  void text(PixelPosition place, const std::string& words, const TextStyle& style) override {
    canvas_.text(move(place), words, style);
  }
  void disc(PixelPosition place, double radius, Rgb8 colour, const std::string&) override {
    canvas_.fill(circle(place, radius), colour);
  }
  void ring(PixelPosition place, double radius) override {
    std::vector<PixelPosition> points = circle(place, radius);
    points.push_back(points.front());
    canvas_.line(points, {.width = 2.0});
  }

 private:
  PixelPosition move(PixelPosition p) const { return {p.x, p.y + down_}; }
  std::vector<PixelPosition> circle(PixelPosition place, double radius) const {
    constexpr int kCorners = 24;
    std::vector<PixelPosition> ring;
    for (int k = 0; k < kCorners; ++k) {
      const double angle = 2.0 * 3.141592653589793 * k / kCorners;
      ring.push_back(
          move({place.x + radius * std::cos(angle), place.y + radius * std::sin(angle)}));
    }
    return ring;
  }

  Canvas& canvas_;
  double down_;
};

constexpr Rgb8 kSoft{86, 93, 101}, kGrid{217, 220, 223}, kShade{240, 240, 234};

void draw_axes(const SpeedChart& chart, const Layout& layout, Pen& pen) {
  const double bottom = kHeight - kBottom, right = kWidth - kRight;
  pen.text({kLeft, 22.0}, chart.title, {.size = 16.0, .bold = true});
  if (chart.floor_pct > kLeastError) {
    pen.box({kLeft, layout.at(1.0, chart.floor_pct).y}, {right, bottom}, kShade);
    pen.text({right - 6.0, layout.at(1.0, chart.floor_pct).y + 14.0}, "not known better than this",
             {.size = 12.0, .colour = kSoft, .align = TextAlign::Right});
  }
  for (const double t : layout.time().ticks(6)) {
    const double x = layout.at(t, 1.0).x;
    pen.line({{x, kTop}, {x, bottom}}, {.colour = kGrid});
    pen.text({x, bottom + 18.0}, rounded_text(t), {.size = 13.0, .align = TextAlign::Centre});
  }
  for (const double e : layout.error().ticks(6)) {
    const double y = layout.at(1.0, e).y;
    pen.line({{kLeft, y}, {right, y}}, {.colour = kGrid});
    pen.text({kLeft - 8.0, y + 4.0}, rounded_text(e), {.size = 13.0, .align = TextAlign::Right});
  }
  pen.text({0.5 * (kLeft + right), kHeight - 14.0}, "time, s",
           {.size = 13.0, .colour = kSoft, .align = TextAlign::Centre});
  pen.text({8.0, kTop - 6.0}, "error (RMS), %", {.size = 13.0, .colour = kSoft});
}

void draw(const SpeedChart& chart, Pen& pen) {
  const Layout layout(chart);
  draw_axes(chart, layout, pen);
  std::vector<PixelPosition> front;
  for (const SpeedMark* m : front_of(chart)) front.push_back(layout.at(*m));
  if (front.size() > 1) pen.line(front, {.width = 7.0, .colour = {150, 155, 160}, .opacity = 0.5});
  double key = kTop + 10.0;
  for (const std::string& line : layout.lines()) {
    const Rgb8 colour = layout.colour(line);
    std::vector<PixelPosition> way;
    const std::vector<const SpeedMark*> marks = sorted_marks(chart, line);
    for (const SpeedMark* m : marks) way.push_back(layout.at(*m));
    if (way.size() > 1) pen.line(way, {.width = 1.5, .colour = colour});
    for (const SpeedMark* m : marks) {
      const PixelPosition at = layout.at(*m);
      const double half = 0.5 * m->spread_s;
      pen.line({layout.at(std::max(m->time_s - half, 0.2 * m->time_s), m->error_pct),
                layout.at(m->time_s + half, m->error_pct)},
               {.colour = colour, .opacity = 0.6});
      pen.disc(at, kMark, colour, m->label);
      if (m->is_knee) pen.ring(at, 1.9 * kMark);
    }
    pen.disc({kWidth - kRight + 22.0, key}, kMark, colour, "");
    pen.text({kWidth - kRight + 36.0, key + 5.0}, line, {.size = 14.0});
    key += 22.0;
  }
  if (front.size() > 1) {
    pen.line({{kWidth - kRight + 12.0, key}, {kWidth - kRight + 32.0, key}},
             {.width = 7.0, .colour = {150, 155, 160}, .opacity = 0.5});
    pen.text({kWidth - kRight + 40.0, key + 5.0}, "nothing faster is better", {.size = 13.0});
    key += 22.0;
    pen.ring({kWidth - kRight + 22.0, key}, 1.6 * kMark);
    pen.text({kWidth - kRight + 40.0, key + 5.0}, "its knee", {.size = 13.0});
  }
}

std::string element(const char* name, const std::string& text, const char* style = "") {
  const std::string open = *style == '\0' ? name : std::string(name) + " class=\"" + style + "\"";
  return "<" + open + ">" + escaped(text) + "</" + name + ">";
}

std::string table_of(const SpeedTable& table) {
  std::string html = element("h2", table.title) + element("p", table.introduction) +
                     "\n<div class=\"scroll\"><table><thead><tr>";
  const auto style = [&](std::size_t k) {
    return k < table.left_aligned || table.header[k] == "remark" ? "id" : "n";
  };
  for (std::size_t k = 0; k < table.header.size(); ++k) {
    html += element("th", table.header[k], style(k));
  }
  html += "</tr></thead><tbody>\n";
  for (const auto& row : table.rows) {
    html += "<tr>";
    for (std::size_t k = 0; k < row.size(); ++k) html += element("td", row[k], style(k));
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

// The wheel makes a chart grow about the pointer, a double click puts it back.
constexpr std::string_view kZoom = R"js(
document.querySelectorAll("svg.zoom").forEach(s=>{
  const whole=s.getAttribute("viewBox"),v=()=>s.viewBox.baseVal;
  s.addEventListener("wheel",e=>{e.preventDefault();
    const b=v(),r=s.getBoundingClientRect(),k=e.deltaY<0?0.8:1.25;
    const x=b.x+(e.clientX-r.left)/r.width*b.width,y=b.y+(e.clientY-r.top)/r.height*b.height;
    s.setAttribute("viewBox",[x-(x-b.x)*k,y-(y-b.y)*k,b.width*k,b.height*k].join(" "));},{passive:false});
  s.addEventListener("dblclick",()=>s.setAttribute("viewBox",whole));
});
)js";

}  // namespace

std::string speed_chart_svg(const SpeedChart& chart) {
  SvgPen pen;
  draw(chart, pen);
  return "<svg class=\"zoom\" viewBox=\"0 0 " + coordinate(kWidth) + " " + coordinate(kHeight) +
         "\" role=\"img\" aria-label=\"" + escaped(chart.title) +
         "\" xmlns=\"http://www.w3.org/2000/svg\" font-family=\"system-ui,sans-serif\">\n" +
         pen.svg + "</svg>\n";
}

Image8 speed_chart_picture(const std::vector<SpeedChart>& charts) {
  const int height = static_cast<int>(kHeight) * std::max<int>(1, static_cast<int>(charts.size()));
  Canvas canvas(static_cast<int>(kWidth), height);
  double down = 0.0;
  for (const SpeedChart& chart : charts) {
    CanvasPen pen(canvas, down);
    draw(chart, pen);
    down += kHeight;
  }
  return canvas.image();
}

std::string error_plan_svg(const ErrorPlan& plan) {
  if (plan.place.empty()) return "";
  Vec3 low = plan.place.front(), high = low;
  for (const Vec3& p : plan.place) {
    low = {std::min(low.x, p.x), std::min(low.y, p.y), 0.0};
    high = {std::max(high.x, p.x), std::max(high.y, p.y), 0.0};
  }
  const double side = std::max({high.x - low.x, high.y - low.y, 1e-6});
  constexpr double kSide = 560.0, kEdge = 30.0;
  const double height = 2.0 * kEdge + kSide * std::max(0.05, (high.y - low.y) / side);
  double most = 1e-9;
  for (const double e : plan.error_pct) most = std::max(most, std::abs(e));
  SvgPen pen;
  const auto at = [&](const Vec3& p) {
    return PixelPosition{kEdge + kSide * (p.x - low.x) / side,
                         height - kEdge - kSide * (p.y - low.y) / side};
  };
  const double radius =
      std::clamp(0.4 * kSide / std::sqrt(static_cast<double>(plan.place.size())), 1.5, 9.0);
  for (std::size_t k = 0; k < plan.place.size(); ++k) {
    const double share = std::min(1.0, std::abs(plan.error_pct[k]) / most);
    const Rgb8 towards = plan.error_pct[k] > 0.0 ? Rgb8{213, 94, 0} : Rgb8{0, 114, 178};
    const auto mixed = [&](std::uint8_t c) {
      return static_cast<std::uint8_t>(std::lround(232.0 + share * (c - 232.0)));
    };
    pen.disc(at(plan.place[k]), radius, {mixed(towards.r), mixed(towards.g), mixed(towards.b)},
             "sensor " + std::to_string(k + 1) + ": " + rounded_text(plan.error_pct[k]) + " %");
  }
  pen.ring(at(plan.place[plan.worst]), radius + 5.0);
  return "<figure class=\"small\"><svg class=\"zoom\" viewBox=\"0 0 " +
         coordinate(kSide + 2.0 * kEdge) + " " + coordinate(height) +
         "\" xmlns=\"http://www.w3.org/2000/svg\" role=\"img\" aria-label=\"" +
         escaped(plan.caption) + "\">\n" + pen.svg + "</svg>" +
         element("figcaption", plan.caption) + "</figure>\n";
}

std::string speed_page(const SpeedPage& page) {
  std::string html = "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>" +
                     escaped(page.title) + "</title>\n<style>" + std::string(report_style()) +
                     "pre{background:var(--tint);padding:1rem;overflow-x:auto}</style></head>\n"
                     "<body><main>" +
                     element("h1", page.title) + element("p", page.where, "where") +
                     element("p", page.lead, "lead") + "\n";
  for (const SpeedChart& chart : page.charts) {
    html += "<figure>" + speed_chart_svg(chart) + "</figure>\n";
  }
  for (const SpeedTable& table : page.tables) {
    html += table_of(table);
    if (&table == &page.tables.front() && !page.fragment.empty()) {
      html += element("p", "For a study, the setting for the finest error that was reached:") +
              "\n<pre>" + escaped(page.fragment) + "</pre>\n";
    }
  }
  if (!page.plans.empty()) html += element("h2", "Where it is wrong") + "\n";
  for (const ErrorPlan& plan : page.plans) html += error_plan_svg(plan);
  if (!page.remarks.empty()) html += element("h2", "How this was measured") + "\n";
  for (const std::string& remark : page.remarks) html += element("p", remark) + "\n";
  return html + "<footer>Made with " + escaped(software_name()) + ".</footer>\n<script>" +
         std::string(kZoom) + "</script></main></body></html>\n";
}

}  // namespace tenku
