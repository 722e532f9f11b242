# Compiles through ccache where it is installed. Paths below the source tree are hashed relative to
# it, so that several checkouts share one cache.
find_program(HARPOON_CCACHE ccache)
if(HARPOON_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CMAKE_COMMAND} -E env CCACHE_BASEDIR=${PROJECT_SOURCE_DIR}
                                  CCACHE_NOHASHDIR=1 ${HARPOON_CCACHE})
endif()
