#include "ode/interposed.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <link.h>

#include <cstdlib>
#include <string>
#include <string_view>
#include <type_traits>

#include "ode/log.hpp"

namespace harpoon::ode {
namespace {

/// Notes the path of the first loaded library whose file is called libode.so or libode.so.*.
int note_libode(dl_phdr_info* info, std::size_t, void* result) {
  const std::string_view path = info->dlpi_name == nullptr ? "" : info->dlpi_name;
  const std::string_view file = path.substr(path.rfind('/') + 1);
  if (file != "libode.so" && !file.starts_with("libode.so.")) return 0;
  *static_cast<std::string*>(result) = path;
  return 1;
}

void* open_private_libode() {
  std::string path;
  dl_iterate_phdr(&note_libode, &path);
  return path.empty() ? nullptr : dlopen(path.c_str(), RTLD_LAZY | RTLD_NOLOAD);
}

Interposed find_all() {
  Interposed all{};
  const auto take = [](const char* name, auto& function) {
    function = reinterpret_cast<std::remove_reference_t<decltype(function)>>(find_in_libode(name));
    if (function == nullptr) {
      write_log_line(LogLevel::error, fmt::format("no {} in this process: no libode is loaded that "
                                                  "harpoon could serve",
                                                  name));
      std::abort();
    }
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
  take("dSweepAndPruneSpaceCreate", all.sap_space_create);
  take("dCreateGeomClass", all.create_geom_class);
  take("dSetColliderOverride", all.set_collider_override);
  take("dCloseODE", all.close_ode);
  take("dGetConfiguration", all.get_configuration);
  return all;
}

}  // namespace

void* find_in_libode(const char* name) {
  if (void* found = dlsym(RTLD_NEXT, name)) return found;
  static void* const kLibrary = open_private_libode();
  return kLibrary == nullptr ? nullptr : dlsym(kLibrary, name);
}

const Interposed& libode() {
  static const Interposed kAll = find_all();
  return kAll;
}

}  // namespace harpoon::ode
