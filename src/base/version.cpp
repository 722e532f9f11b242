#include "harpoon/version.hpp"

#define HARPOON_STRING_OF(x) #x
#define HARPOON_STRING(x) HARPOON_STRING_OF(x)

namespace harpoon {

std::string_view version() noexcept {
  return HARPOON_STRING(HARPOON_VERSION_MAJOR) "." HARPOON_STRING(
      HARPOON_VERSION_MINOR) "." HARPOON_STRING(HARPOON_VERSION_PATCH);
}

}  // namespace harpoon
