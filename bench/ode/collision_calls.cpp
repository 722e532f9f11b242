#include "bench/ode/collision_calls.hpp"

#include <dlfcn.h>

namespace harpoon::bench {

CollisionCalls stock_calls() {
  // The address of a function that nobody interposes tells which file libode is.
  Dl_info info{};
  CollisionCalls calls;
  if (dladdr(reinterpret_cast<const void*>(&dWorldCreate), &info) == 0) return calls;
  void* const library = dlopen(info.dli_fname, RTLD_LAZY | RTLD_NOLOAD);
  if (library == nullptr) return calls;
  calls.space_collide =
      reinterpret_cast<decltype(calls.space_collide)>(dlsym(library, "dSpaceCollide"));
  calls.collide = reinterpret_cast<decltype(calls.collide)>(dlsym(library, "dCollide"));
  return calls;
}

CollisionCalls linked_calls() {
  return {&dSpaceCollide, &dCollide};
}

bool drop_in_is_interposed() {
  const CollisionCalls stock = stock_calls();
  // What this program is linked to, found as the dynamic linker finds it.
  const void* const seen = dlsym(RTLD_DEFAULT, "dSpaceCollide");
  return stock.space_collide != nullptr &&
         seen != reinterpret_cast<const void*>(stock.space_collide);
}

}  // namespace harpoon::bench
