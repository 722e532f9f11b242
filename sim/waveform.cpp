#include "waveform.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "Vharpoon_afu.h"

namespace harpoon::sim {
namespace {

struct Signal {
  const char* name;
  unsigned width;
  std::uint64_t (*value)(const Vharpoon_afu&);
};

// Data buses are represented by their first 64 bits.
constexpr auto kSignals = std::to_array<Signal>({
    {"ap_rst_n", 1, [](const Vharpoon_afu& t) -> std::uint64_t { return t.ap_rst_n; }},
    {"control_awvalid", 1,
     [](const Vharpoon_afu& t) -> std::uint64_t { return t.s_axi_control_awvalid; }},
    {"control_awaddr", 16,
     [](const Vharpoon_afu& t) -> std::uint64_t { return t.s_axi_control_awaddr; }},
    {"control_wdata", 32,
     [](const Vharpoon_afu& t) -> std::uint64_t { return t.s_axi_control_wdata; }},
    {"control_arvalid", 1,
     [](const Vharpoon_afu& t) -> std::uint64_t { return t.s_axi_control_arvalid; }},
    {"control_araddr", 16,
     [](const Vharpoon_afu& t) -> std::uint64_t { return t.s_axi_control_araddr; }},
    {"control_rvalid", 1,
     [](const Vharpoon_afu& t) -> std::uint64_t { return t.s_axi_control_rvalid; }},
    {"control_rdata", 32,
     [](const Vharpoon_afu& t) -> std::uint64_t { return t.s_axi_control_rdata; }},
    {"arvalid", 1, [](const Vharpoon_afu& t) -> std::uint64_t { return t.m_axi_arvalid; }},
    {"arready", 1, [](const Vharpoon_afu& t) -> std::uint64_t { return t.m_axi_arready; }},
    {"arid", 8, [](const Vharpoon_afu& t) -> std::uint64_t { return t.m_axi_arid; }},
    {"araddr", 64, [](const Vharpoon_afu& t) -> std::uint64_t { return t.m_axi_araddr; }},
    {"rvalid", 1, [](const Vharpoon_afu& t) -> std::uint64_t { return t.m_axi_rvalid; }},
    {"rid", 8, [](const Vharpoon_afu& t) -> std::uint64_t { return t.m_axi_rid; }},
    {"rresp", 2, [](const Vharpoon_afu& t) -> std::uint64_t { return t.m_axi_rresp; }},
    {"rdata_low", 64,
     [](const Vharpoon_afu& t)
         -> std::uint64_t { return t.m_axi_rdata[0] | std::uint64_t{t.m_axi_rdata[1]} << 32; }},
    {"awvalid", 1, [](const Vharpoon_afu& t) -> std::uint64_t { return t.m_axi_awvalid; }},
    {"awready", 1, [](const Vharpoon_afu& t) -> std::uint64_t { return t.m_axi_awready; }},
    {"awid", 8, [](const Vharpoon_afu& t) -> std::uint64_t { return t.m_axi_awid; }},
    {"awaddr", 64, [](const Vharpoon_afu& t) -> std::uint64_t { return t.m_axi_awaddr; }},
    {"wvalid", 1, [](const Vharpoon_afu& t) -> std::uint64_t { return t.m_axi_wvalid; }},
    {"wready", 1, [](const Vharpoon_afu& t) -> std::uint64_t { return t.m_axi_wready; }},
    {"wdata_low", 64,
     [](const Vharpoon_afu& t)
         -> std::uint64_t { return t.m_axi_wdata[0] | std::uint64_t{t.m_axi_wdata[1]} << 32; }},
    {"bvalid", 1, [](const Vharpoon_afu& t) -> std::uint64_t { return t.m_axi_bvalid; }},
    {"bid", 8, [](const Vharpoon_afu& t) -> std::uint64_t { return t.m_axi_bid; }},
    {"bresp", 2, [](const Vharpoon_afu& t) -> std::uint64_t { return t.m_axi_bresp; }},
});

char symbol(std::size_t index) {
  return static_cast<char>('!' + index);
}

}  // namespace

Waveform::~Waveform() {
  if (sink_) sink_(text_);
}

void Waveform::open(WaveformSink sink, double clock_mhz) {
  sink_ = std::move(sink);
  period_ps_ = static_cast<std::uint64_t>(std::llround(1e6 / clock_mhz));
  last_.assign(kSignals.size(), 0);
  text_ = "$timescale 1ps $end\n$scope module harpoon_afu $end\n";
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    text_ +=
        fmt::format("$var wire {} {} {} $end\n", kSignals[i].width, symbol(i), kSignals[i].name);
  }
  text_ += "$upscope $end\n$enddefinitions $end\n";
}

void Waveform::sample(std::uint64_t cycle, const Vharpoon_afu& top) {
  constexpr std::size_t kPieceBytes = std::size_t{1} << 16;
  text_ += fmt::format("#{}\n", cycle * period_ps_);
  for (std::size_t i = 0; i < kSignals.size(); ++i) {
    const std::uint64_t value = kSignals[i].value(top);
    if (!first_ && value == last_[i]) continue;
    last_[i] = value;
    text_ += fmt::format("b{:0{}b} {}\n", value, kSignals[i].width, symbol(i));
  }
  first_ = false;
  if (text_.size() < kPieceBytes) return;
  sink_(text_);
  text_.clear();
}

}  // namespace harpoon::sim
