#include "device/validate.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdint>

namespace harpoon {
namespace {

/// A named stretch of the caller's memory.
struct Buffer {
  const char* name;
  const void* data;
  std::uint64_t bytes;
  std::size_t alignment;
};

template <class T>
Buffer buffer(const char* name, const T* data, std::uint64_t count) {
  return {name, data, count * sizeof(T), alignof(T)};
}

std::uintptr_t address(const Buffer& b) {
  return reinterpret_cast<std::uintptr_t>(b.data);
}

bool overlap(const Buffer& a, const Buffer& b) {
  return a.bytes != 0 && b.bytes != 0 && address(a) < address(b) + b.bytes &&
         address(b) < address(a) + a.bytes;
}

std::optional<Error> check_buffer(const Buffer& b) {
  if (b.bytes == 0) return std::nullopt;
  if (b.data == nullptr) {
    return Error{Errc::invalid_argument,
                 fmt::format("{} is null but {} bytes of it are used; pass a valid buffer", b.name,
                             b.bytes)};
  }
  if (address(b) % b.alignment != 0) {
    return Error{
        Errc::invalid_argument,
        fmt::format("{} is not aligned to {} bytes; pass an aligned buffer", b.name, b.alignment)};
  }
  return std::nullopt;
}

/// Buffers [0, inputs) are read, the others written: no written one may overlap any other.
template <std::size_t N>
std::optional<Error> check_buffers(const std::array<Buffer, N>& buffers, std::size_t inputs) {
  for (const Buffer& b : buffers) {
    if (auto error = check_buffer(b)) return error;
  }
  for (std::size_t out = inputs; out < N; ++out) {
    for (std::size_t other = 0; other < out; ++other) {
      if (overlap(buffers[out], buffers[other])) {
        return Error{Errc::invalid_argument, fmt::format("{} overlaps {}; pass separate buffers",
                                                         buffers[out].name, buffers[other].name)};
      }
    }
  }
  return std::nullopt;
}

std::optional<Error> check_count(std::uint64_t pairs) {
  if (pairs <= kMaxBatchPairs) return std::nullopt;
  return Error{Errc::batch_too_large,
               fmt::format("the batch has {} pairs, the limit is {}; submit it in parts", pairs,
                           kMaxBatchPairs)};
}

std::optional<Error> check_sizes(std::uint64_t pairs, std::uint64_t contacts) {
  if (auto error = check_count(pairs)) return error;
  if (contacts < pairs) return contacts_capacity_error(contacts, pairs);
  return std::nullopt;
}

template <class Real>
std::optional<Error> check(const PairBatch<Real>& batch) {
  if (auto error = check_sizes(batch.pairs.size(), batch.contacts.size())) return error;
  const std::uint64_t count = batch.pairs.size();
  return check_buffers(std::array{buffer("pairs", batch.pairs.data(), count),
                                  buffer("contacts", batch.contacts.data(), count)},
                       1);
}

template <class Real>
std::optional<Error> check(const PairArraysBatch<Real>& batch) {
  const SpherePairArraysOf<Real>& p = batch.pairs;
  const ContactArraysOf<Real>& c = batch.contacts;
  if (auto error = check_sizes(p.count, c.count)) return error;
  const std::uint64_t n = p.count;
  return check_buffers(
      std::array{
          buffer("pairs.x1", p.x1, n), buffer("pairs.y1", p.y1, n), buffer("pairs.z1", p.z1, n),
          buffer("pairs.r1", p.r1, n), buffer("pairs.x2", p.x2, n), buffer("pairs.y2", p.y2, n),
          buffer("pairs.z2", p.z2, n), buffer("pairs.r2", p.r2, n),
          buffer("contacts.pos_x", c.pos_x, n), buffer("contacts.pos_y", c.pos_y, n),
          buffer("contacts.pos_z", c.pos_z, n), buffer("contacts.normal_x", c.normal_x, n),
          buffer("contacts.normal_y", c.normal_y, n), buffer("contacts.normal_z", c.normal_z, n),
          buffer("contacts.depth", c.depth, n), buffer("contacts.flow", c.flow, n)},
      8);
}

template <class Real>
std::optional<Error> check(const IndexedBatch<Real>& batch) {
  if (auto error = check_count(batch.pairs.size())) return error;
  return check_buffers(std::array{buffer("spheres", batch.spheres.data(), batch.spheres.size()),
                                  buffer("pairs", batch.pairs.data(), batch.pairs.size()),
                                  buffer("contacts", batch.contacts.data(), batch.contacts.size())},
                       2);
}

}  // namespace

std::optional<Error> validate(const Batch& batch) {
  return std::visit([](const auto& b) { return check(b); }, batch);
}

Error index_error(std::uint64_t pair, const IndexPair& indices, std::uint64_t spheres) {
  const bool first = indices.g1 >= spheres;
  return {
      Errc::invalid_index,
      fmt::format("pair {} names body {} as {}, but there are {} spheres; indices must be below "
                  "that",
                  pair, first ? indices.g1 : indices.g2, first ? "g1" : "g2", spheres)};
}

Error contacts_capacity_error(std::uint64_t capacity, std::uint64_t needed) {
  return {Errc::capacity,
          fmt::format("contacts holds {} records but {} are needed; pass a larger buffer", capacity,
                      needed),
          needed};
}

}  // namespace harpoon
