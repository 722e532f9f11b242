#include "ode/libodes.hpp"

#include <dlfcn.h>
#include <link.h>

#include <cstdlib>
#include <cstring>
#include <new>
#include <type_traits>

namespace harpoon::ode {
namespace {

/// What every libode has and nobody stands in front of.
constexpr const char* kMarks[] = {"dGeomGetClass", "dSpaceGetNumGeoms", "dGeomGetSpace",
                                  "dSpaceClean"};

/// A loaded file.
struct Module {
  std::uintptr_t begin = 0, end = 0;
  [[nodiscard]] bool contains(std::uintptr_t address) const {
    return begin <= address && address < end;
  }
};

std::uintptr_t number_of(const void* address) {
  return reinterpret_cast<std::uintptr_t>(address);
}

Module extent_of(const dl_phdr_info& info) {
  Module module;
  for (int k = 0; k < info.dlpi_phnum; ++k) {
    const auto& segment = info.dlpi_phdr[k];
    if (segment.p_type != PT_LOAD) continue;
    const std::uintptr_t begin = info.dlpi_addr + segment.p_vaddr;
    if (module.end == 0) module.begin = begin;
    module.end = begin + segment.p_memsz;
  }
  return module;
}

/// The module that an address is in; empty: none.
Module module_of(std::uintptr_t address) {
  struct Search {
    std::uintptr_t address;
    Module found;
  } search{address, {}};
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* data) {
        Search& wanted = *static_cast<Search*>(data);
        const Module module = extent_of(*info);
        if (!module.contains(wanted.address)) return 0;
        wanted.found = module;
        return 1;
      },
      &search);
  return search.found;
}

/// A handle of the module that an address is in, to be closed; null: it has none. It must be asked
/// for by name, because only then can functions be looked up; what has that name is made sure of.
void* open_module_of(std::uintptr_t address) {
  Dl_info info{};
  void* map = nullptr;
  if (dladdr1(reinterpret_cast<void*>(address), &info, &map, RTLD_DL_LINKMAP) == 0) return nullptr;
  const char* const name = static_cast<link_map*>(map)->l_name;
  // The program itself has none; the kernel's has no folder.
  if (*name != '\0' && std::strchr(name, '/') == nullptr) return nullptr;
  void* const handle = dlopen(*name == '\0' ? nullptr : name, RTLD_LAZY | RTLD_NOLOAD);
  if (handle == map || handle == nullptr) return handle;
  dlclose(handle);
  return nullptr;
}

const char* path_of(void* handle) {
  return static_cast<link_map*>(handle)->l_name;
}

/// Whether a module defines itself what makes a libode.
bool is_libode(void* handle, const Module& module) {
  for (const char* mark : kMarks) {
    if (module.contains(number_of(dlsym(handle, mark)))) return true;
  }
  return false;
}

bool is_global(const Module& module) {
  for (const char* mark : kMarks) {
    if (module.contains(number_of(dlsym(RTLD_NEXT, mark)))) return true;
  }
  return false;
}

Interposed find_all(const Libode& libode) {
  Interposed all{};
  const auto take = [&](const char* name, auto& function) {
    function =
        reinterpret_cast<std::remove_reference_t<decltype(function)>>(find_in_libode(libode, name));
  };
  take("dSpaceCollide", all.space_collide);
  take("dSpaceCollide2", all.space_collide2);
  take("dCollide", all.collide);
  take("dGeomMoved", all.geom_moved);
  take("dGeomDestroy", all.geom_destroy);
  take("dGeomSetBody", all.geom_set_body);
  take("dGeomSetCategoryBits", all.geom_set_category_bits);
  take("dGeomSetCollideBits", all.geom_set_collide_bits);
  take("dGeomEnable", all.geom_enable);
  take("dGeomDisable", all.geom_disable);
  take("dGeomIsEnabled", all.geom_is_enabled);
  take("dSpaceAdd", all.space_add);
  take("dSpaceRemove", all.space_remove);
  take("dHashSpaceSetLevels", all.hash_space_set_levels);
  take("dSimpleSpaceCreate", all.simple_space_create);
  take("dHashSpaceCreate", all.hash_space_create);
  take("dQuadTreeSpaceCreate", all.quadtree_space_create);
  take("dSweepAndPruneSpaceCreate", all.sap_space_create);
  take("dCreateGeomClass", all.create_geom_class);
  take("dSetColliderOverride", all.set_collider_override);
  take("dInitODE", all.init_ode);
  take("dInitODE2", all.init_ode2);
  take("dCloseODE", all.close_ode);
  return all;
}

int no_collide(dxGeom*, dxGeom*, int, void*, int) {
  return 0;
}
void no_geom_moved(dxGeom*) {}

/// The libode at the address, found before or now; null when there is none.
Libode* know(std::uintptr_t address) {
  for (Libode* libode = libodes.load(std::memory_order_acquire); libode != nullptr;
       libode = libode->next) {
    if (libode->contains(address)) return libode;
  }
  const Module module = module_of(address);
  if (module.end == 0 || is_own(address)) return nullptr;
  void* const handle = open_module_of(address);
  if (handle == nullptr) return nullptr;
  void* const memory = is_libode(handle, module) ? std::malloc(sizeof(Libode)) : nullptr;
  if (memory == nullptr) {
    dlclose(handle);
    return nullptr;
  }
  auto* const libode = new (memory) Libode;
  libode->path = path_of(handle);
  // Never closed: its functions are kept.
  libode->handle = handle;
  libode->is_global = is_global(module);
  libode->begin = module.begin;
  libode->size = module.end - module.begin;
  libode->stock = find_all(*libode);
  libode->collide = libode->stock.collide != nullptr ? libode->stock.collide : &no_collide;
  libode->geom_moved =
      libode->stock.geom_moved != nullptr ? libode->stock.geom_moved : &no_geom_moved;
  Libode* first = libodes.load(std::memory_order_acquire);
  do {
    // Another thread may have found it meanwhile.
    for (Libode* other = first; other != nullptr; other = other->next) {
      if (!other->contains(address)) continue;
      std::free(memory);
      return other;
    }
    libode->next = first;
  } while (!libodes.compare_exchange_weak(first, libode, std::memory_order_acq_rel));
  routes_changed();
  return libode;
}

/// Finds all libodes that are loaded, where anything was loaded since the last time.
void know_all() {
  constexpr std::size_t kMost = 4096;
  struct Modules {
    std::uintptr_t begins[kMost];
    std::size_t count = 0;
    unsigned long long loaded = 0;
  };
  static constinit std::atomic<unsigned long long> loaded_before{0};
  void* const memory = std::malloc(sizeof(Modules));
  if (memory == nullptr) return;
  auto* const modules = new (memory) Modules;
  // The linker's lock is held while it goes through the list: nothing is asked of it meanwhile.
  dl_iterate_phdr(
      [](dl_phdr_info* info, std::size_t, void* data) {
        Modules& all = *static_cast<Modules*>(data);
        all.loaded = info->dlpi_adds;
        const Module module = extent_of(*info);
        if (module.end != 0 && all.count < kMost) all.begins[all.count++] = module.begin;
        return 0;
      },
      modules);
  if (loaded_before.exchange(modules->loaded) != modules->loaded) {
    for (std::size_t k = 0; k < modules->count; ++k) (void)know(modules->begins[k]);
  }
  std::free(memory);
}

/// The libode that the dynamic linker finds for everybody, or null.
Libode* global_libode() {
  for (const char* mark : kMarks) {
    if (void* const found = dlsym(RTLD_NEXT, mark)) return know(number_of(found));
  }
  return nullptr;
}

/// The one that a module was linked to, or null.
Libode* libode_linked_to(std::uintptr_t address) {
  if (is_own(address)) return nullptr;
  void* const handle = open_module_of(address);
  if (handle == nullptr) return nullptr;
  Libode* libode = nullptr;
  for (const char* mark : kMarks) {
    if (void* const found = dlsym(handle, mark)) {
      libode = know(number_of(found));
      break;
    }
  }
  dlclose(handle);
  return libode;
}

}  // namespace

bool is_own(std::uintptr_t address) {
  // Threads that come at once write the same.
  static constinit std::atomic<std::uintptr_t> begin{0}, end{0};
  if (end.load(std::memory_order_acquire) == 0) {
    const Module module = module_of(number_of(reinterpret_cast<void*>(&is_own)));
    begin.store(module.begin, std::memory_order_relaxed);
    end.store(module.end, std::memory_order_release);
  }
  return begin.load(std::memory_order_relaxed) <= address &&
         address < end.load(std::memory_order_relaxed);
}

Libode* find_libode_of(const void* object) {
  know_all();
  return know(*static_cast<const std::uintptr_t*>(object));
}

Libode* libode_of_caller(const void* return_address) {
  know_all();
  const std::uintptr_t address = number_of(return_address);
  Libode* const last = libodes.load(std::memory_order_acquire);
  for (Libode* libode = last; libode != nullptr; libode = libode->next) {
    if (libode->contains(address)) return libode;
  }
  if (Libode* const global = global_libode()) return global;
  if (Libode* const linked = libode_linked_to(address)) return linked;
  return last;
}

void* find_in_libode(const Libode& libode, const char* name) {
  if (libode.is_global) {
    if (void* const found = dlsym(RTLD_NEXT, name)) return found;
  }
  void* const found = dlsym(libode.handle, name);
  return is_own(number_of(found)) ? nullptr : found;
}

}  // namespace harpoon::ode
