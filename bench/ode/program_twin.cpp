#include "bench/ode/program_twin.hpp"

#include <sys/socket.h>

#include <cerrno>
#include <cstddef>

#include "bench/ode/runtime.hpp"
#include "bench/timer.hpp"

namespace harpoon::bench {
namespace {

/// Asks for a program to be made, or for a step of the one made last.
struct Request {
  bool makes = false;
  ProgramKind kind = ProgramKind::diamond10;
  std::uint64_t geoms = 0, seed = 0;
};

/// Followed by the state.
struct Reply {
  double step_ms = 0;
  Program::Work work;
  std::uint64_t state_size = 0;
};

bool send_all(int socket, const void* data, std::size_t bytes) {
  const auto* next = static_cast<const std::byte*>(data);
  while (bytes > 0) {
    const ssize_t sent = ::send(socket, next, bytes, MSG_NOSIGNAL);
    if (sent < 0 && errno == EINTR) continue;
    if (sent <= 0) return false;
    next += sent;
    bytes -= static_cast<std::size_t>(sent);
  }
  return true;
}

bool receive_all(int socket, void* data, std::size_t bytes) {
  auto* next = static_cast<std::byte*>(data);
  while (bytes > 0) {
    const ssize_t received = ::recv(socket, next, bytes, 0);
    if (received < 0 && errno == EINTR) continue;
    if (received <= 0) return false;
    next += received;
    bytes -= static_cast<std::size_t>(received);
  }
  return true;
}

}  // namespace

ProgramRun::ProgramRun(ProgramKind kind, std::size_t geoms, std::uint64_t seed)
    : program_(make_program(kind, geoms, seed)) {
  dRandSetSeed(seed);
}

ProgramStep ProgramRun::step() {
  ProgramStep step;
  const double begin_ns = now_ns();
  step.work = program_->step();
  step.step_ms = (now_ns() - begin_ns) * 1e-6;
  program_->append_state(step.state);
  return step;
}

void serve_programs(int socket) {
  const OdeRuntime ode;
  std::optional<ProgramRun> run;
  Request request;
  while (receive_all(socket, &request, sizeof request)) {
    if (request.makes) {
      run.emplace(request.kind, request.geoms, request.seed);
      continue;
    }
    if (!run) return;
    const ProgramStep step = run->step();
    const Reply reply{step.step_ms, step.work, step.state.size()};
    if (!send_all(socket, &reply, sizeof reply) ||
        !send_all(socket, step.state.data(), step.state.size() * sizeof(dReal))) {
      return;
    }
  }
}

ProgramTwin::ProgramTwin(int socket, ProgramKind kind, std::size_t geoms, std::uint64_t seed)
    : socket_(socket) {
  const Request request{true, kind, geoms, seed};
  is_there_ = send_all(socket, &request, sizeof request);
}

std::optional<ProgramStep> ProgramTwin::step() {
  const Request request;
  Reply reply;
  if (!is_there_ || !send_all(socket_, &request, sizeof request) ||
      !receive_all(socket_, &reply, sizeof reply)) {
    return std::nullopt;
  }
  ProgramStep step{reply.step_ms, reply.work, std::vector<dReal>(reply.state_size)};
  if (!receive_all(socket_, step.state.data(), step.state.size() * sizeof(dReal))) {
    return std::nullopt;
  }
  return step;
}

}  // namespace harpoon::bench
