#include "conchoid/study/experiments/svg_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace conchoid {
namespace {

constexpr double kLeft = 70, kTop = 12, kWidth = 440, kHeight = 260, kLegend = 250, kBottom = 46;
// Colours that stay apart for the colour-blind (Okabe & Ito 2008).
constexpr std::array kColors = {"#000000", "#0072B2", "#D55E00", "#009E73", "#CC79A7",
                                "#E69F00", "#56B4E9", "#7F7F7F", "#8B4513"};

/// One axis: from values to pixels.
struct Axis {
  bool logarithmic = false;
  double low = 0, high = 1;      // of the values, or of their logarithms
  double begin = 0, length = 1;  // pixels; negative length: upwards

  bool shows(double v) const { return std::isfinite(v) && (!logarithmic || v > 0); }
  double place(double v) const {
    return begin + length * ((logarithmic ? std::log10(v) : v) - low) / (high - low);
  }
  std::vector<double> ticks() const;
};

// 1, 2 or 5 times a power of ten, so that about five steps fill the range.
double round_step(double range) {
  const double raw = range / 5, power = std::pow(10, std::floor(std::log10(raw)));
  for (const double factor : {1.0, 2.0, 5.0})
    if (factor * power >= raw) return factor * power;
  return 10 * power;
}

std::vector<double> Axis::ticks() const {
  std::vector<double> out;
  if (logarithmic) {
    const bool decades = high - low > 1.2;
    for (double e = std::floor(low); e <= std::ceil(high); ++e)
      for (const double factor : decades ? std::vector{1.0} : std::vector{1.0, 2.0, 5.0})
        if (const double at = std::log10(factor) + e; at >= low - 1e-9 && at <= high + 1e-9)
          out.push_back(factor * std::pow(10, e));
    return out;
  }
  const double step = round_step(high - low);
  for (double i = std::ceil(low / step - 1e-9); i * step <= high + 1e-9 * step; ++i)
    out.push_back(i * step);
  return out;
}

Axis fitted(const ReportPlot& plot, std::size_t component, bool logarithmic, double begin, double length) {
  Axis axis{logarithmic, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity(),
            begin, length};
  for (const PlotSeries& series : plot.series)
    for (const auto& point : series.points) {
      if (!axis.shows(point[component])) continue;
      const double v = logarithmic ? std::log10(point[component]) : point[component];
      axis.low = std::min(axis.low, v);
      axis.high = std::max(axis.high, v);
    }
  if (!(axis.low <= axis.high)) axis.low = axis.high = logarithmic ? 0 : 0.5;
  if (!logarithmic && component == 1 && axis.low > 0) axis.low = 0;
  const double margin = axis.high > axis.low ? 0.03 * (axis.high - axis.low) : 0.5;
  axis.low -= axis.low == 0 ? 0 : margin;
  axis.high += margin;
  return axis;
}

std::string axes_svg(const ReportPlot& plot, const Axis& x, const Axis& y) {
  std::string out = fmt::format("<rect x='{}' y='{}' width='{}' height='{}' fill='none' stroke='#888'/>",
                                kLeft, kTop, kWidth, kHeight);
  for (const double v : x.ticks())
    out += fmt::format(
        "<line x1='{0:.1f}' x2='{0:.1f}' y1='{1}' y2='{2}' stroke='#ddd'/><text x='{0:.1f}' "
        "y='{3}' text-anchor='middle'>{4:g}</text>",
        x.place(v), kTop, kTop + kHeight, kTop + kHeight + 15, v);
  for (const double v : y.ticks())
    out += fmt::format(
        "<line x1='{1}' x2='{2}' y1='{0:.1f}' y2='{0:.1f}' stroke='#ddd'/><text x='{3}' "
        "y='{4:.1f}' text-anchor='end'>{5:.3g}</text>",
        y.place(v), kLeft, kLeft + kWidth, kLeft - 5, y.place(v) + 4, v);
  out += fmt::format("<text x='{}' y='{}' text-anchor='middle'>{}</text>", kLeft + kWidth / 2,
                     kTop + kHeight + 36, escaped_text(plot.x));
  out += fmt::format("<text transform='translate(14,{}) rotate(-90)' text-anchor='middle'>{}</text>",
                     kTop + kHeight / 2, escaped_text(plot.y));
  return out;
}

std::string series_svg(const PlotSeries& series, const char* color, const Axis& x, const Axis& y) {
  std::string path, dots;
  for (const auto& [px, py] : series.points) {
    if (!x.shows(px) || !y.shows(py)) continue;
    path += fmt::format("{}{:.1f} {:.1f}", path.empty() ? "M" : "L", x.place(px), y.place(py));
    dots += fmt::format("<circle cx='{:.1f}' cy='{:.1f}' r='2' fill='{}'/>", x.place(px), y.place(py), color);
  }
  return fmt::format("<path d='{}' fill='none' stroke='{}' stroke-width='1.5'{}/>{}", path, color,
                     series.dashed ? " stroke-dasharray='5 3'" : "", dots);
}

}  // namespace

std::string escaped_text(const std::string& text) {
  std::string out;
  for (const char c : text)
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\'':
        out += "&#39;";
        break;
      default:
        out += c;
    }
  return out;
}

std::string plot_svg(const ReportPlot& plot) {
  const Axis x = fitted(plot, 0, plot.logarithmic_x, kLeft, kWidth);
  const Axis y = fitted(plot, 1, plot.logarithmic_y, kTop + kHeight, -kHeight);
  const double height =
      std::max(kTop + kHeight + kBottom, kTop + 20 + 18.0 * static_cast<double>(plot.series.size()));
  std::string out = fmt::format(
      "<svg xmlns='http://www.w3.org/2000/svg' viewBox='0 0 {0:.0f} {1:.0f}' width='{0:.0f}' "
      "height='{1:.0f}' font-family='sans-serif' font-size='11'>",
      kLeft + kWidth + kLegend, height);
  out += axes_svg(plot, x, y);
  for (std::size_t i = 0; i < plot.series.size(); ++i) {
    const char* color = kColors[i % kColors.size()];
    const double at = kTop + 10 + 18.0 * static_cast<double>(i), left = kLeft + kWidth + 12;
    out += series_svg(plot.series[i], color, x, y);
    out += fmt::format(
        "<line x1='{0}' x2='{1}' y1='{2}' y2='{2}' stroke='{3}' stroke-width='2'{4}/><text x='{5}' "
        "y='{6}'>{7}</text>",
        left, left + 20, at, color, plot.series[i].dashed ? " stroke-dasharray='5 3'" : "", left + 26, at + 4,
        escaped_text(plot.series[i].name));
  }
  return out + "</svg>";
}

}  // namespace conchoid
