#include "simulated_link.hpp"

#include <cmath>
#include <utility>

#include "Vharpoon_afu.h"
#include "coverage.hpp"
#include "verilated.h"

namespace harpoon::sim {
namespace {

constexpr int kResetCycles = 4;
constexpr int kRegisterTimeoutCycles = 64;

std::uint64_t cycles(double ns, double clock_mhz) {
  return static_cast<std::uint64_t>(std::llround(ns * clock_mhz / 1000));
}

}  // namespace

struct SimulatedLink::State {
  explicit State(const SimulationOptions& options)
      : memory(options.memory_seed), model(options.profile, options.noise, memory) {}

  void cycle();
  void hold_reset();
  void respond(const AxiResponse& response);
  [[nodiscard]] AxiRequest request() const;

  VerilatedContext context;
  Vharpoon_afu top{&context};
  PhysicalMemory memory;
  LinkModel model;
  Waveform waveform;
  afu::LinkInfo info;
  std::uint64_t now = 0, register_write_cycles = 0, register_read_cycles = 0;
};

void SimulatedLink::State::respond(const AxiResponse& response) {
  top.m_axi_arready = response.ar_ready;
  top.m_axi_awready = response.aw_ready;
  top.m_axi_wready = response.w_ready;
  top.m_axi_rvalid = response.r_valid;
  top.m_axi_rid = static_cast<CData>(response.r_id);
  top.m_axi_rresp = static_cast<CData>(response.r_resp);
  top.m_axi_rlast = response.r_valid;
  if (response.r_valid) {
    for (std::size_t i = 0; i < response.r_data.size(); ++i)
      top.m_axi_rdata[i] = response.r_data[i];
  }
  top.m_axi_bvalid = response.b_valid;
  top.m_axi_bid = static_cast<CData>(response.b_id);
  top.m_axi_bresp = static_cast<CData>(response.b_resp);
}

AxiRequest SimulatedLink::State::request() const {
  AxiRequest out{};
  out.ar_valid = top.m_axi_arvalid;
  out.aw_valid = top.m_axi_awvalid;
  out.w_valid = top.m_axi_wvalid;
  out.ar_id = top.m_axi_arid;
  out.aw_id = top.m_axi_awid;
  out.ar_address = top.m_axi_araddr;
  out.aw_address = top.m_axi_awaddr;
  out.w_data = &top.m_axi_wdata[0];
  out.single_beats = top.m_axi_arlen == 0 && top.m_axi_awlen == 0 && top.m_axi_arsize == 6 &&
                     top.m_axi_awsize == 6 && top.m_axi_arburst == 1 && top.m_axi_awburst == 1 &&
                     top.m_axi_wlast && top.m_axi_wstrb == ~QData{0};
  return out;
}

void SimulatedLink::State::cycle() {
  respond(model.drive());
  top.ap_clk = 0;
  top.eval();
  model.sample(request());
  if (waveform.is_open()) waveform.sample(now, top);
  top.ap_clk = 1;
  top.eval();
  ++now;
  if (model.take_reset()) hold_reset();
}

void SimulatedLink::State::hold_reset() {
  top.ap_rst_n = 0;
  top.s_axi_control_awvalid = 0;
  top.s_axi_control_wvalid = 0;
  top.s_axi_control_arvalid = 0;
  top.s_axi_control_bready = 1;
  top.s_axi_control_rready = 1;
  top.s_axi_control_wstrb = 0xf;
  respond({});
  for (int i = 0; i < kResetCycles; ++i) {
    top.ap_clk = 0;
    top.eval();
    top.ap_clk = 1;
    top.eval();
    ++now;
  }
  top.ap_rst_n = 1;
  model.reset();
}

SimulatedLink::SimulatedLink(std::unique_ptr<State> state) : state_(std::move(state)) {}

// Verilator's model destructor unregisters itself from the thread's current context, whichever that
// is: it must be this model's, and afterwards one that lives on.
SimulatedLink::~SimulatedLink() {
  state_->top.final();
  write_coverage(state_->context);
  Verilated::threadContextp(&state_->context);
  state_.reset();
  Verilated::threadContextp(Verilated::defaultContextp());
}

Result<std::unique_ptr<SimulatedLink>> SimulatedLink::create(const SimulationOptions& options) {
  const LinkProfile& profile = options.profile;
  if (std::optional<Error> wrong = check_profile(profile)) return std::move(*wrong);
  auto state = std::make_unique<State>(options);
  state->register_write_cycles = cycles(profile.register_write_ns, profile.clock_mhz);
  state->register_read_cycles = cycles(profile.register_read_ns, profile.clock_mhz);
  state->info = {std::string(profile.name),
                 std::string(profile.description),
                 profile.clock_mhz,
                 profile.gigabytes_per_s * 1000 / profile.clock_mhz,
                 profile.shared_bandwidth,
                 profile.lines_in_flight,
                 profile.read_latency_ns + profile.write_latency_ns,
                 true};
  if (options.waveform) state->waveform.open(options.waveform, profile.clock_mhz);
  state->hold_reset();
  return std::unique_ptr<SimulatedLink>(new SimulatedLink(std::move(state)));
}

const afu::LinkInfo& SimulatedLink::info() const noexcept {
  return state_->info;
}

void SimulatedLink::write_register(std::uint32_t offset, std::uint32_t value) {
  Vharpoon_afu& top = state_->top;
  const std::uint64_t end = state_->now + state_->register_write_cycles;
  top.s_axi_control_awvalid = 1;
  top.s_axi_control_wvalid = 1;
  top.s_axi_control_awaddr = static_cast<SData>(offset);
  top.s_axi_control_wdata = value;
  bool accepted = false;
  for (int i = 0; i < kRegisterTimeoutCycles && !accepted; ++i) {
    top.ap_clk = 0;
    top.eval();
    accepted = top.s_axi_control_awready && top.s_axi_control_wready;
    state_->cycle();
  }
  top.s_axi_control_awvalid = 0;
  top.s_axi_control_wvalid = 0;
  // The host takes the answer a cycle after it came.
  top.s_axi_control_bready = 0;
  state_->cycle();
  top.s_axi_control_bready = 1;
  while (state_->now < end) state_->cycle();
}

std::uint32_t SimulatedLink::read_register(std::uint32_t offset) {
  Vharpoon_afu& top = state_->top;
  const std::uint64_t end = state_->now + state_->register_read_cycles;
  top.s_axi_control_arvalid = 1;
  top.s_axi_control_araddr = static_cast<SData>(offset);
  top.s_axi_control_rready = 0;
  std::uint32_t value = 0;
  for (int i = 0; i < kRegisterTimeoutCycles; ++i) {
    state_->cycle();
    top.s_axi_control_arvalid = 0;
    if (top.s_axi_control_rvalid) {
      value = top.s_axi_control_rdata;
      break;
    }
  }
  state_->cycle();
  top.s_axi_control_rready = 1;
  do {
    state_->cycle();
  } while (state_->now < end);
  return value;
}

Result<afu::SharedMemory> SimulatedLink::allocate(std::uint64_t bytes) {
  return state_->memory.allocate(bytes);
}

void SimulatedLink::release(const afu::SharedMemory& memory) noexcept {
  state_->memory.release(memory);
}

void SimulatedLink::advance(std::uint64_t cycles) {
  do {
    state_->cycle();
  } while (cycles-- > 1);
}

std::uint64_t SimulatedLink::now() const noexcept {
  return state_->now;
}

void SimulatedLink::reset() {
  state_->hold_reset();
}

LinkModel& SimulatedLink::model() noexcept {
  return state_->model;
}

}  // namespace harpoon::sim
