#include "bench/chart.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace harpoon::bench {
namespace {

constexpr double kWidth = 640, kHeight = 360, kLeft = 56, kRight = 130, kTop = 16, kBottom = 40;
constexpr std::array kColours = {"#1b6ca8", "#c8553d", "#588157", "#8e5aa8", "#b08900", "#444"};
/// Logarithmic axes of more decades than this have a mark for each decade only.
constexpr double kMostDividedDecades = 3;
/// Marks of a linear axis, about.
constexpr double kLinearMarks = 6;

/// Where a value lies between the ends of an axis, 0 to 1.
double part(const ChartAxis& axis, double value) {
  return axis.logarithmic ? std::log(value / axis.low) / std::log(axis.high / axis.low)
                          : (value - axis.low) / (axis.high - axis.low);
}

double x_of(const Chart& chart, double value) {
  return kLeft + (kWidth - kLeft - kRight) * part(chart.x, value);
}
double y_of(const Chart& chart, double value) {
  return kHeight - kBottom - (kHeight - kTop - kBottom) * part(chart.y, value);
}

struct Mark {
  double value;
  std::string text;
};

std::vector<Mark> decade_marks(const ChartAxis& axis) {
  const bool divided = std::log10(axis.high / axis.low) < kMostDividedDecades;
  const double end = axis.high * 1.01;
  std::vector<Mark> marks;
  for (double power = std::ceil(std::log10(axis.low) - 0.01); std::pow(10, power) <= end; ++power) {
    const double decade = std::pow(10, power);
    if (!divided) {
      marks.push_back({decade, fmt::format("10^{:.0f}", power)});
      continue;
    }
    for (const double step : {1.0, 2.0, 5.0}) {
      if (decade * step <= end)
        marks.push_back({decade * step, fmt::format("{:g}", decade * step)});
    }
  }
  return marks;
}

/// At multiples of 1, 2 or 5 times a power of ten.
std::vector<Mark> linear_marks(const ChartAxis& axis) {
  const double rough = (axis.high - axis.low) / kLinearMarks;
  const double decade = std::pow(10, std::floor(std::log10(rough)));
  const double lead = rough / decade;
  const double step = decade * (lead <= 1 ? 1 : lead <= 2 ? 2 : lead <= 5 ? 5 : 10);
  std::vector<Mark> marks;
  for (double k = std::ceil(axis.low / step); k * step <= axis.high; ++k) {
    marks.push_back({k * step, fmt::format("{:g}", k * step)});
  }
  return marks;
}

std::vector<Mark> marks_of(const ChartAxis& axis) {
  return axis.logarithmic ? decade_marks(axis) : linear_marks(axis);
}

std::string label(double x, double y, const char* anchor, const std::string& text) {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor,
                     text);
}

std::string grid_line(double x1, double y1, double x2, double y2) {
  return fmt::format(
      "<line x1=\"{:.1f}\" y1=\"{:.1f}\" x2=\"{:.1f}\" y2=\"{:.1f}\" stroke=\"#ccc\"/>\n", x1, y1,
      x2, y2);
}

std::string grid(const Chart& chart) {
  std::string svg;
  for (const Mark& mark : marks_of(chart.x)) {
    const double x = x_of(chart, mark.value);
    svg += grid_line(x, kHeight - kBottom, x, kTop);
    svg += label(x, kHeight - 22, "middle", mark.text);
  }
  for (const Mark& mark : marks_of(chart.y)) {
    const double y = y_of(chart, mark.value);
    svg += grid_line(kLeft, y, kWidth - kRight, y);
    svg += label(kLeft - 6, y + 4, "end", mark.text);
  }
  return svg + label(kLeft, kHeight - 6, "start", chart.caption);
}

std::string line(const Chart& chart, const ChartLine& line, const char* colour) {
  if (line.points.empty()) return "";
  std::string places;
  for (const ChartPoint& p : line.points) {
    places += fmt::format("{:.1f},{:.1f} ", x_of(chart, p.x), y_of(chart, p.y));
  }
  return fmt::format("<polyline points=\"{}\" fill=\"none\" stroke=\"{}\" stroke-width=\"2\"/>\n",
                     places, colour) +
         label(kWidth - kRight + 6, y_of(chart, line.points.back().y) + 4, "start",
               fmt::format("<tspan fill=\"{}\">{}</tspan>", colour, line.name));
}

}  // namespace

ChartAxis decades_around(double low, double high) {
  const double first = std::floor(std::log10(low));
  return {std::pow(10, first), std::pow(10, std::max(first + 1, std::ceil(std::log10(high)))),
          true};
}

std::string to_svg(const Chart& chart) {
  std::string svg = fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" font-family=\"sans-serif\" font-size=\"12\">\n<rect width=\"100%\" "
      "height=\"100%\" fill=\"#fff\"/>\n",
      kWidth, kHeight);
  svg += grid(chart);
  for (std::size_t k = 0; k < chart.lines.size(); ++k) {
    svg += line(chart, chart.lines[k], kColours[k % kColours.size()]);
  }
  return svg + "</svg>\n";
}

}  // namespace harpoon::bench
