// However large a text is, what its readers hold is bounded by its bodies, and what is no text of
// bodies ends early: counted in bytes read and bytes of memory, never in time.

#include <gtest/gtest.h>

#include <cstring>

#include "apps/counted_memory.hpp"
#include "apps/detect/bodies_file.hpp"
#include "apps/device_catalog.hpp"

namespace harpoon::app {
namespace {

/// Bytes beside the bodies: one buffer and small change.
constexpr std::size_t kFixedBytes = 2 * kLookAheadBytes;

/// `head`, then `part` again and again, then `tail`; in all `bytes` or a little more.
class Endless {
 public:
  Endless(std::string head, std::string part, std::string tail, std::uint64_t bytes)
      : piece_(std::move(head)), part_(std::move(part)), tail_(std::move(tail)), left_(bytes) {}

  std::size_t operator()(std::span<char> to) {
    std::size_t filled = 0;
    while (filled < to.size()) {
      if (at_ == piece_.size() && !next_piece()) break;
      const std::size_t some = std::min(to.size() - filled, piece_.size() - at_);
      std::memcpy(to.data() + filled, piece_.data() + at_, some);
      filled += some;
      at_ += some;
    }
    *read_ += filled;
    return filled;
  }
  [[nodiscard]] std::uint64_t read() const { return *read_; }

 private:
  bool next_piece() {
    if (is_over_) return false;
    is_over_ = left_ < part_.size();
    left_ -= is_over_ ? 0 : part_.size();
    piece_ = is_over_ ? tail_ : part_;
    at_ = 0;
    return !piece_.empty();
  }

  std::string piece_, part_, tail_;
  std::uint64_t left_;
  std::size_t at_ = 0;
  bool is_over_ = false;
  std::shared_ptr<std::uint64_t> read_ = std::make_shared<std::uint64_t>(0);
};

BodiesOrError read(const Endless& text, bool as_json) {
  TextSource source(text, 0, {});
  return as_json ? read_bodies_json(source) : read_bodies_csv(source);
}

TEST(ReaderMemory, IsAtMostThreeTimesTheBodies) {
  const std::string digits = ".1415926535897932384626433832795028841971693993751058209749445923";
  const struct {
    const char *head, *part, *tail;
    bool as_json;
    std::size_t body_bytes;
  } texts[] = {
      {"x,y,z,r\n", "0,0,0,1\n", "", false, 32},
      {"x,y,z,r,group,mask\n", "0,0,0,1,2,3\n", "", false, 40},
      {"x,y,z,r\n", "1DIGITS,2DIGITS,3DIGITS,4DIGITS\n", "", false, 32},
      {"# much\n\n", "# is not a body\n", "x,y,z,r\n0,0,0,1\n", false, 32},
      {"[", "{\"x\":0,\"y\":0,\"z\":0,\"r\":1},", "{\"x\":0,\"y\":0,\"z\":0,\"r\":1}]", true, 32},
      {"{\"bodies\":[", "{\"x\":1DIGITS, \"y\" : 2DIGITS,\n\"z\":0,\"mask\":7,\"r\":1},\n",
       "{\"x\":0,\"y\":0,\"z\":0,\"r\":1}]}", true, 40},
  };
  for (const auto& text : texts) {
    std::string part = text.part;
    for (std::size_t at; (at = part.find("DIGITS")) != std::string::npos;) {
      part.replace(at, 6, digits);
    }
    // Sizes at which a growing array has just moved, and others.
    for (const std::uint64_t bytes : {1000, 300000, 1000000, 5000000, 7654321}) {
      const Endless endless(text.head, part, text.tail, bytes);
      reset_peak();
      const BodiesOrError bodies = read(endless, text.as_json);
      const std::size_t peak = peak_bytes();
      ASSERT_TRUE(std::holds_alternative<FileBodies>(bodies)) << std::get<TextError>(bodies).reason;
      const std::size_t decoded = std::get<FileBodies>(bodies).spheres.size() * text.body_bytes;
      EXPECT_LE(peak, 3 * decoded + kFixedBytes) << text.part << " " << bytes;
      EXPECT_GT(peak, decoded) << "nothing was counted";
    }
  }
}

TEST(ReaderLimits, EndWhatIsNoTextOfBodiesEarly) {
  constexpr std::uint64_t kGigabyte = std::uint64_t{1} << 30;
  const std::string zeros(4096, '\0');
  const std::string blanks(4096, ' ');
  const std::string letters(4096, 'a');
  const std::string digits(4096, '7');
  const struct {
    std::string head, part;
    const char* csv;   ///< of the reason
    const char* json;  ///< the same
  } texts[] = {
      {"", zeros, "binary", "binary"},
      {"x,y,z,r\n0,0,0,1\n", zeros, "binary", "binary"},
      {"", letters, "a line of more than 65536 bytes", "syntax error"},
      {"x,y,z,r\n", digits, "a line of more than 65536 bytes", "syntax error"},
      {"x,y,z,r\n0,0,0,1" + std::string(300000, '0') + "\n", digits,
       "a line of more than 65536 bytes", "syntax error"},
      {"x,y,z,r\n0,0,0," + std::string(2000, '1') + "\n", "0,0,0,1\n",
       "a field of more than 1024 bytes", "syntax error"},
      {"", blanks, "a line of more than 65536 bytes", "blanks of more than 65536 bytes"},
      {"[{\"x\":", blanks, "JSON", "blanks of more than 65536 bytes"},
      {"[{\"x\":", digits, "JSON", "a name, number or text of more than 1024 bytes"},
      {"[{\"", letters, "JSON", "a name, number or text of more than 1024 bytes"},
      {"[{\"x\": \"", letters, "JSON", "a name, number or text of more than 1024 bytes"},
      {"[{\"x\\\"", letters + "\\\"", "JSON", "a name, number or text of more than 1024 bytes"},
      {"", "[", "JSON", "an array is out of place"},
      {"", "{\"bodies\":", "JSON", "an object is out of place"},
      {"[", "{\"x\":", "JSON", "an object is out of place"},
      {"[", ",", "JSON", "syntax error"},
      {"", "x", "a line of more than 65536 bytes", "syntax error"},
  };
  for (const auto& text : texts) {
    for (const bool as_json : {false, true}) {
      const Endless endless(text.head, text.part, "", kGigabyte);
      reset_peak();
      const BodiesOrError bodies = read(endless, as_json);
      EXPECT_LE(peak_bytes(), kFixedBytes + text.head.size()) << text.head.substr(0, 20);
      // The head may be longer than what is looked ahead at.
      EXPECT_LE(endless.read(), text.head.size() + 2 * kLookAheadBytes) << text.head.substr(0, 20);
      const auto* error = std::get_if<TextError>(&bodies);
      ASSERT_NE(error, nullptr) << text.head.substr(0, 20);
      EXPECT_NE(error->reason.find(as_json ? text.json : text.csv), std::string::npos)
          << (as_json ? "json " : "csv ") << text.head.substr(0, 20) << ": " << error->reason;
      EXPECT_LE(error->reason.size(), 4 * kMostTokenBytes);
    }
  }
}

TEST(DeviceNames, NeedNoDevice) {
  reset_peak();
  const std::string choices = device_choices();
  EXPECT_LT(peak_bytes(), 10000U) << "a device was made";
  EXPECT_NE(choices.find("afu"), std::string::npos);
}

}  // namespace
}  // namespace harpoon::app
