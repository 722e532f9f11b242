// A program to which Harpoon is unknown, and which knows of ODE only what its modules do with it.
//
//   host [--deepbind] [--underscore-exit] [--folder DIR] MODULE...
//
// loads each module privately, lets all of them step in turn and prints what each has seen.

#include <dlfcn.h>
#include <unistd.h>

#include <cinttypes>
#include <cstdio>
#include <cstring>
#include <vector>

namespace {

template <class Function>
Function* find(void* module, const char* name) {
  return reinterpret_cast<Function*>(dlsym(module, name));
}

}  // namespace

int main(int argc, char** argv) {
  int flags = RTLD_NOW | RTLD_LOCAL;
  bool underscore_exit = false;
  std::vector<void*> modules;
  for (int k = 1; k < argc; ++k) {
    if (std::strcmp(argv[k], "--deepbind") == 0) {
      flags |= RTLD_DEEPBIND;
    } else if (std::strcmp(argv[k], "--underscore-exit") == 0) {
      underscore_exit = true;
    } else if (std::strcmp(argv[k], "--folder") == 0) {
      if (chdir(argv[++k]) != 0) return 2;
    } else if (void* const module = dlopen(argv[k], flags)) {
      modules.push_back(module);
    } else {
      std::puts(dlerror());
      return 3;
    }
  }
  for (void* module : modules) find<void()>(module, "begin")();
  for (int number = 0; number < 240; ++number) {
    for (void* module : modules) find<void(int)>(module, "step")(number);
  }
  for (void* module : modules) {
    std::printf("%" PRIx64 "\n", find<std::uint64_t()>(module, "end")());
  }
  if (underscore_exit) {
    std::fflush(stdout);
    _exit(0);
  }
}
