#include "apps/file_kind.hpp"

#include <algorithm>
#include <array>

namespace harpoon::app {
namespace {

using namespace std::string_view_literals;

struct Magic {
  std::string_view bytes;
  std::string_view kind;
};

// Longer ones before those that they begin with.
constexpr std::array kMagics = {
    Magic{"\x1F\x8B"sv, "gzip data; decompress it first"},
    Magic{"BZh"sv, "bzip2 data; decompress it first"},
    Magic{"\xFD\x37zXZ\0"sv, "xz data; decompress it first"},
    Magic{"\x28\xB5\x2F\xFD"sv, "zstd data; decompress it first"},
    Magic{"7z\xBC\xAF\x27\x1C"sv, "a 7z archive; unpack it first"},
    Magic{"PK\x03\x04"sv, "a zip archive, perhaps a spreadsheet; unpack it, or save it as CSV"},
    Magic{"\xD0\xCF\x11\xE0"sv, "an old spreadsheet or document; save it as CSV"},
    Magic{"\x89HDF\r\n\x1A\n"sv, "HDF5 data; export it as CSV"},
    Magic{"CDF\x01"sv, "NetCDF data; export it as CSV"},
    Magic{"CDF\x02"sv, "NetCDF data; export it as CSV"},
    Magic{"\x93NUMPY"sv, "a NumPy array; save it with numpy.savetxt"},
    Magic{"PAR1"sv, "Parquet data; export it as CSV"},
    Magic{"%PDF"sv, "a PDF"},
    Magic{"\x89PNG"sv, "a PNG picture"},
    Magic{"\x7F"
          "ELF"sv,
          "a program or library"},
    Magic{"\xFF\xFE\0\0"sv, "text in UTF-32; save it as UTF-8"},
    Magic{"\0\0\xFE\xFF"sv, "text in UTF-32; save it as UTF-8"},
    Magic{"\xFF\xFE"sv, "text in UTF-16; save it as UTF-8"},
    Magic{"\xFE\xFF"sv, "text in UTF-16; save it as UTF-8"},
};

/// ASCII with a zero byte before or behind each character.
bool is_utf16_without_mark(std::string_view text) {
  std::size_t zeros[2] = {};
  std::size_t characters = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\0') {
      ++zeros[i % 2];
    } else if (static_cast<unsigned char>(text[i]) < 0x7F) {
      ++characters;
    }
  }
  const std::size_t pairs = text.size() / 2;
  return pairs >= 2 && std::min(zeros[0], zeros[1]) == 0 && std::max(zeros[0], zeros[1]) >= pairs &&
         characters >= pairs;
}

}  // namespace

std::string other_than_text(std::string_view beginning) {
  for (const Magic& magic : kMagics) {
    if (beginning.starts_with(magic.bytes)) return std::string(magic.kind);
  }
  if (beginning.find('\0') == std::string_view::npos) return "";
  constexpr std::size_t kEnough = 4096;
  if (is_utf16_without_mark(beginning.substr(0, kEnough))) {
    return "text in UTF-16; save it as UTF-8";
  }
  return "binary data, not a text";
}

}  // namespace harpoon::app
