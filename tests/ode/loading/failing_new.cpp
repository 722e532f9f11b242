// Preloaded behind Harpoon: operator new throws at the FAIL_AT-th call, and at every further one
// when FAIL_ALWAYS is set. Calls by the program and by libode are left alone.

#include <dlfcn.h>

#include <cstdlib>
#include <cstring>
#include <initializer_list>
#include <new>

namespace {

bool is_harpoons(const void* caller) {
  Dl_info info{};
  if (dladdr(caller, &info) == 0) return false;
  for (const char* name : {"libharpoon", "libtbb", "libfmt", "libstdc++"}) {
    if (std::strstr(info.dli_fname, name) != nullptr) return true;
  }
  return false;
}

void* allocate(std::size_t size, const void* caller) {
  static const char* const fail_at = std::getenv("FAIL_AT");
  static const bool always = std::getenv("FAIL_ALWAYS") != nullptr;
  static long left = fail_at == nullptr ? -1 : std::atol(fail_at);
  if (left >= 0 && is_harpoons(caller)) {
    if (left == 0) {
      if (!always) left = -1;
      throw std::bad_alloc();
    }
    --left;
  }
  if (void* const memory = std::malloc(size)) return memory;
  throw std::bad_alloc();
}

}  // namespace

void* operator new(std::size_t size) {
  return allocate(size, __builtin_return_address(0));
}
void* operator new[](std::size_t size) {
  return allocate(size, __builtin_return_address(0));
}
void operator delete(void* memory) noexcept {
  std::free(memory);
}
void operator delete[](void* memory) noexcept {
  std::free(memory);
}
void operator delete(void* memory, std::size_t) noexcept {
  std::free(memory);
}
void operator delete[](void* memory, std::size_t) noexcept {
  std::free(memory);
}
