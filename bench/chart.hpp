#pragma once

// A chart of lines as SVG, for the documentation. It draws what it is given and computes nothing.

#include <string>
#include <vector>

namespace harpoon::bench {

struct ChartAxis {
  double low = 0, high = 1;
  bool logarithmic = false;  ///< low > 0; else low may have any sign
};

struct ChartPoint {
  double x, y;  ///< within the axes
};

struct ChartLine {
  std::string name;  ///< written at the line's end
  std::vector<ChartPoint> points;
};

struct Chart {
  ChartAxis x, y;
  std::string caption;  ///< says what x and y are
  std::vector<ChartLine> lines;
};

/// The smallest axis from one power of ten to another that holds both values, which are > 0.
ChartAxis decades_around(double low, double high);

std::string to_svg(const Chart& chart);

}  // namespace harpoon::bench
