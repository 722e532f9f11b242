# What `cmake --install` lays down beside the library: headers, the CMake package, harpoon.pc.
# The command installs its own man page and completions (apps/).
include(CMakePackageConfigHelpers)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/harpoon DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(TARGETS harpoon EXPORT harpoon-targets)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/harpoon)
install(EXPORT harpoon-targets NAMESPACE harpoon:: DESTINATION ${package_folder})
configure_package_config_file(cmake/harpoon-config.cmake.in harpoon-config.cmake
  INSTALL_DESTINATION ${package_folder}
  NO_SET_AND_CHECK_MACRO)
write_basic_package_version_file(harpoon-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/harpoon-config.cmake
              ${PROJECT_BINARY_DIR}/harpoon-config-version.cmake
        DESTINATION ${package_folder})

# A static libharpoon needs its dependencies from whoever links to it, a shared one does not.
set(pc_requires "")
set(pc_libs_private "")
if(NOT BUILD_SHARED_LIBS)
  set(pc_requires "tbb fmt")
  if(HARPOON_HIGHWAY_LIBRARY)
    string(APPEND pc_requires " libhwy")
  endif()
  set(pc_libs_private "-lstdc++ -lm -lpthread")
endif()
file(RELATIVE_PATH pc_to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(cmake/harpoon.pc.in harpoon.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/harpoon.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
