# harpoon_verilate(NAME library TOP module [ROOMS room...] [SOURCES file...] [OPTIONS flag...])
#
# Turns a SystemVerilog module into a C++ library with Verilator: link to `library`, include
# "V<module>.h". ROOMS are folders of rtl/ in which modules and packages are looked for; SOURCES are
# further files, such as a test's own top. Lint warnings are errors, but for rtl/waivers.vlt.
#
# HARPOON_HAVE_VERILATOR tells whether the function can be used. Models are compiled by clang++ if
# there is one (a fifth faster than g++ here), optimised whatever the build type.

include_guard(GLOBAL)  # what later includers read is cached: they are in other folders

find_program(HARPOON_VERILATOR verilator)
find_program(HARPOON_MAKE make DOC "What Verilator builds its models with")
if(NOT HARPOON_VERILATOR OR NOT HARPOON_MAKE)
  set(HARPOON_HAVE_VERILATOR OFF CACHE INTERNAL "May harpoon_verilate be called?")
  message(STATUS "harpoon: no Verilator, or no make for it: the RTL is neither built nor tested")
  return()
endif()
set(HARPOON_HAVE_VERILATOR ON CACHE INTERNAL "May harpoon_verilate be called?")
# Its makefiles announce every archive; what goes wrong is told on the other stream.
set(HARPOON_VERILATE sh -c "exec \"$@\" >/dev/null" verilator ${HARPOON_VERILATOR}
    CACHE INTERNAL "Verilator, quiet")

find_program(HARPOON_MODEL_CXX NAMES clang++ clang++-14 DOC "Compiler of the Verilated models")
if(NOT HARPOON_MODEL_CXX)
  set(HARPOON_MODEL_CXX ${CMAKE_CXX_COMPILER} CACHE FILEPATH "" FORCE)
endif()
execute_process(COMMAND ${HARPOON_VERILATOR} --getenv VERILATOR_ROOT
                OUTPUT_VARIABLE HARPOON_VERILATOR_ROOT OUTPUT_STRIP_TRAILING_WHITESPACE)

# Verilator's run time, once for all models.
add_library(harpoon_verilated STATIC EXCLUDE_FROM_ALL
  ${HARPOON_VERILATOR_ROOT}/include/verilated.cpp
  ${HARPOON_VERILATOR_ROOT}/include/verilated_cov.cpp
  ${HARPOON_VERILATOR_ROOT}/include/verilated_threads.cpp)
target_include_directories(harpoon_verilated SYSTEM PUBLIC
  ${HARPOON_VERILATOR_ROOT}/include ${HARPOON_VERILATOR_ROOT}/include/vltstd)
target_compile_options(harpoon_verilated PRIVATE -w -O2)
target_link_libraries(harpoon_verilated PUBLIC Threads::Threads)

function(harpoon_verilate)
  cmake_parse_arguments(arg "" "NAME;TOP" "ROOMS;SOURCES;OPTIONS" ${ARGN})
  set(rtl ${PROJECT_SOURCE_DIR}/rtl)
  set(folder ${CMAKE_CURRENT_BINARY_DIR}/${arg_NAME})
  set(archive ${folder}/V${arg_TOP}__ALL.a)

  set(search "")
  set(sources "")
  set(depends ${rtl}/waivers.vlt)
  foreach(room ${arg_ROOMS})
    file(GLOB room_packages CONFIGURE_DEPENDS ${rtl}/${room}/*_pkg.sv)
    file(GLOB room_files CONFIGURE_DEPENDS ${rtl}/${room}/*.sv)
    list(APPEND search -y ${rtl}/${room})
    list(APPEND sources ${room_packages})
    list(APPEND depends ${room_files})
    if(EXISTS ${rtl}/${room}/${arg_TOP}.sv)
      set(top ${rtl}/${room}/${arg_TOP}.sv)
    endif()
  endforeach()
  list(APPEND sources ${arg_SOURCES} ${top})
  list(APPEND depends ${arg_SOURCES})

  set(make_flags "-s CXX=${HARPOON_MODEL_CXX} OPT_FAST=-O3 OPT_GLOBAL=-O2 OPT_SLOW=-O0")
  if(HARPOON_CCACHE)
    string(APPEND make_flags " OBJCACHE=${HARPOON_CCACHE}")
  endif()
  add_custom_command(
    OUTPUT ${archive}
    COMMAND ${HARPOON_VERILATE} --cc --build -O3 -Wall --top-module ${arg_TOP} --Mdir ${folder}
            -MAKEFLAGS ${make_flags} -CFLAGS -w ${arg_OPTIONS} ${rtl}/waivers.vlt ${search}
            ${sources}
    DEPENDS ${depends}
    COMMENT "Verilating ${arg_TOP}"
    VERBATIM)
  add_custom_target(${arg_NAME}_archive DEPENDS ${archive})
  add_library(${arg_NAME} INTERFACE)
  add_dependencies(${arg_NAME} ${arg_NAME}_archive)
  target_include_directories(${arg_NAME} SYSTEM INTERFACE ${folder})
  target_link_libraries(${arg_NAME} INTERFACE ${archive} harpoon_verilated)
endfunction()
