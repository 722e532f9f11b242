#pragma once

/// Errors as values. Every fallible function of the library returns a `Result`, or an optional
/// `Error` where there is no value; nothing throws across the public boundary.

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

#include "harpoon/export.hpp"

namespace harpoon {

enum class Errc : std::uint8_t {
  invalid_argument,  ///< null, misaligned or overlapping buffers, bad option value
  invalid_index,     ///< an index pair names a body that is not in the sphere array
  capacity,          ///< the output buffer is too small; `Error::needed` says how large it must be
  batch_too_large,   ///< more than `kMaxBatchPairs` pairs in one batch
  out_of_memory,     ///< an allocation failed; inputs and outputs are as documented per call
  executor_failed,   ///< the injected parallel_for threw or did not run every task once
  unsupported,       ///< this device does not do this precision or format
  device_unavailable,  ///< the device is not on this machine or not in this build
  device_timeout,      ///< the device did not answer within its time limit
  device_fault,        ///< the device reported a fault
};

/// The identifier of a code, for example "invalid_index". Never null; static storage.
HARPOON_API std::string_view to_string(Errc code) noexcept;

struct Error {
  Errc code = Errc::invalid_argument;
  /// What is wrong, in words for people, with the offending pair or number where there is one and
  /// the remedy where it does not follow; no trailing newline.
  std::string message;
  /// For `Errc::capacity`: the number of output records that the call needs. Otherwise 0.
  std::uint64_t needed = 0;
};

/// A value or an Error. Access to the one that is absent is a programming error (undefined).
template <class T>
class [[nodiscard]] Result {
 public:
  Result(T value) : state_(std::move(value)) {}      // NOLINT(google-explicit-constructor)
  Result(Error error) : state_(std::move(error)) {}  // NOLINT(google-explicit-constructor)

  [[nodiscard]] bool ok() const noexcept { return state_.index() == 0; }
  explicit operator bool() const noexcept { return ok(); }

  [[nodiscard]] const T& value() const& noexcept { return *std::get_if<0>(&state_); }
  [[nodiscard]] T& value() & noexcept { return *std::get_if<0>(&state_); }
  [[nodiscard]] T&& value() && noexcept { return std::move(*std::get_if<0>(&state_)); }
  [[nodiscard]] const Error& error() const noexcept { return *std::get_if<1>(&state_); }

  const T& operator*() const& noexcept { return value(); }
  T& operator*() & noexcept { return value(); }
  T&& operator*() && noexcept { return std::move(*this).value(); }
  const T* operator->() const noexcept { return &value(); }
  T* operator->() noexcept { return &value(); }

 private:
  std::variant<T, Error> state_;
};

}  // namespace harpoon
