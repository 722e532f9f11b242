#include "bench/copy_bandwidth.hpp"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <thread>
#include <vector>

#include "bench/timer.hpp"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace harpoon::bench {
namespace {

constexpr std::size_t kLine = 64;

#if defined(__x86_64__)

constexpr std::size_t kPage = 4096;

void stream_lines_sse2(const std::byte* source, std::byte* target, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; i += sizeof(__m128i)) {
    const __m128i v = _mm_loadu_si128(reinterpret_cast<const __m128i*>(source + i));
    _mm_stream_si128(reinterpret_cast<__m128i*>(target + i), v);
  }
}

__attribute__((target("avx512f"))) void stream_lines_avx512(const std::byte* source,
                                                            std::byte* target, std::size_t bytes) {
  for (std::size_t i = 0; i < bytes; i += sizeof(__m512i)) {
    const __m512i v = _mm512_loadu_si512(source + i);
    _mm512_stream_si512(reinterpret_cast<__m512i*>(target + i), v);
  }
}

void copy_non_temporal(const std::byte* source, std::byte* target, std::size_t bytes) {
  const auto address = reinterpret_cast<std::uintptr_t>(target);
  const std::size_t head = std::min(bytes, (kLine - address % kLine) % kLine);
  const std::size_t body = (bytes - head) / kLine * kLine;
  std::memcpy(target, source, head);
  const bool wide = __builtin_cpu_supports("avx512f") != 0;
  for (std::size_t i = 0; i < body; i += kPage) {
    // Streaming stores look up the page they go to one after the other: a touch ahead of time takes
    // that out of the way. It never faults, so it may be past the end.
    _mm_prefetch(reinterpret_cast<const char*>(address + head + i + kPage), _MM_HINT_T0);
    const auto stream = wide ? stream_lines_avx512 : stream_lines_sse2;
    stream(source + head + i, target + head + i, std::min(kPage, body - i));
  }
  std::memcpy(target + head + body, source + head + body, bytes - head - body);
  _mm_sfence();
}

#else

void copy_non_temporal(const std::byte* source, std::byte* target, std::size_t bytes) {
  std::memcpy(target, source, bytes);
}

#endif

void copy_slice(CopyMethod method, std::span<const std::byte> source, std::span<std::byte> target) {
  if (method == CopyMethod::library) {
    std::memcpy(target.data(), source.data(), source.size());
  } else {
    copy_non_temporal(source.data(), target.data(), source.size());
  }
}

class CopyContestant final : public Contestant {
 public:
  CopyContestant(CopyMethod method, std::span<const std::byte> source, std::span<std::byte> target,
                 unsigned threads)
      : method_(method),
        source_(source),
        target_(target),
        label_{"copy",  "bytes",
               threads, method == CopyMethod::library ? "memcpy" : "non-temporal",
               false,   2.0 * kBytesPerPair} {}

  [[nodiscard]] const Label& label() const override { return label_; }

  Result<Turn> take_turn(std::size_t count) override {
    const std::size_t bytes = std::min(count * kBytesPerPair, source_.size());
    return take_samples(copies_ns(bytes, 1).value(),
                        [&](std::uint64_t runs) { return copies_ns(bytes, runs); });
  }

 private:
  static constexpr std::size_t kBytesPerPair = 32;

  Result<double> copies_ns(std::size_t bytes, std::uint64_t runs) {
    const double start = now_ns();
    for (std::uint64_t i = 0; i < runs; ++i) {
      copy_with(method_, source_.first(bytes), target_.first(bytes), label_.threads);
    }
    return now_ns() - start;
  }

  CopyMethod method_;
  std::span<const std::byte> source_;
  std::span<std::byte> target_;
  Label label_;
};

}  // namespace

void copy_with(CopyMethod method, std::span<const std::byte> source, std::span<std::byte> target,
               unsigned threads) {
  const std::size_t slice = (source.size() / threads + kLine - 1) / kLine * kLine;
  const auto copy_part = [&](unsigned part) {
    const std::size_t begin = std::min(source.size(), part * slice);
    const std::size_t end =
        part + 1 == threads ? source.size() : std::min(source.size(), begin + slice);
    copy_slice(method, source.subspan(begin, end - begin), target.subspan(begin, end - begin));
  };
  std::vector<std::jthread> helpers;
  for (unsigned part = 1; part < threads; ++part) {
    helpers.emplace_back(copy_part, part);
  }
  copy_part(0);
}

std::unique_ptr<Contestant> make_copy_contestant(CopyMethod method,
                                                 std::span<const std::byte> source,
                                                 std::span<std::byte> target, unsigned threads) {
  return std::make_unique<CopyContestant>(method, source, target, threads);
}

}  // namespace harpoon::bench
