#include "bench/ode/twin.hpp"

#include <sys/socket.h>

#include <cerrno>
#include <cstddef>
#include <type_traits>

#include "bench/ode/runtime.hpp"
#include "bench/timer.hpp"

namespace harpoon::bench {
namespace {

/// Asks for a subject to be made, or for steps of the one made last.
struct Request {
  bool makes = false;
  Subject subject = {};
  unsigned steps = 0;
  bool compares = false;
};
static_assert(std::is_trivially_copyable_v<Request>);

/// Followed by as many steps as were asked for and by the state.
struct Reply {
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

/// Vectors travel without their sizes.
template <class Value>
bool send_all(int socket, const std::vector<Value>& values) {
  return send_all(socket, values.data(), values.size() * sizeof(Value));
}

template <class Value>
bool receive_all(int socket, std::vector<Value>& values) {
  return receive_all(socket, values.data(), values.size() * sizeof(Value));
}

std::unique_ptr<Program> make(const ProgramSubject& subject) {
  return make_program(subject.kind, subject.geoms, subject.seed);
}

std::unique_ptr<Program> make(const WorldSubject& subject) {
  return std::make_unique<DropInWorld>(subject.kind, subject.space, subject.geoms, subject.seed);
}

}  // namespace

SubjectRun::SubjectRun(const Subject& subject)
    : program_(std::visit([](const auto& one) { return make(one); }, subject)) {
  dRandSetSeed(std::visit([](const auto& one) { return one.seed; }, subject));
}

TwinTurn SubjectRun::turn(unsigned steps, bool compares) {
  TwinTurn turn;
  turn.steps.reserve(steps);
  for (unsigned k = 0; k < steps; ++k) {
    const double begin_ns = now_ns();
    const Program::Work work = compares ? program_->compared_step() : program_->step();
    turn.steps.push_back({(now_ns() - begin_ns) * 1e-6, work});
    if (compares) program_->append_state(turn.state);
  }
  return turn;
}

void serve_twins(int socket) {
  const OdeRuntime ode;
  std::optional<SubjectRun> run;
  Request request;
  while (receive_all(socket, &request, sizeof request)) {
    if (request.makes) {
      run.emplace(request.subject);
      continue;
    }
    if (!run) return;
    const TwinTurn turn = run->turn(request.steps, request.compares);
    const Reply reply{turn.state.size()};
    if (!send_all(socket, &reply, sizeof reply) || !send_all(socket, turn.steps) ||
        !send_all(socket, turn.state)) {
      return;
    }
  }
}

Twin::Twin(int socket, const Subject& subject) : socket_(socket) {
  const Request request{.makes = true, .subject = subject};
  is_there_ = send_all(socket, &request, sizeof request);
}

std::optional<TwinTurn> Twin::turn(unsigned steps, bool compares) {
  const Request request{.steps = steps, .compares = compares};
  Reply reply;
  if (!is_there_ || !send_all(socket_, &request, sizeof request) ||
      !receive_all(socket_, &reply, sizeof reply)) {
    return std::nullopt;
  }
  TwinTurn turn{std::vector<TimedStep>(steps), std::vector<dReal>(reply.state_size)};
  if (!receive_all(socket_, turn.steps) || !receive_all(socket_, turn.state)) return std::nullopt;
  return turn;
}

}  // namespace harpoon::bench
