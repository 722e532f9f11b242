# Gives the target harpoon_commit: link to it and include "generated/commit.hpp" for
# harpoon::kCommit, the commit that is being built ("unknown" without git, "-dirty" appended when
# files differ from it). The header is looked at in every build and rewritten only when it changes.
#
# This file is also the script that the build runs: cmake -DSOURCE=.. -DHEADER=.. -P commit.cmake
if(CMAKE_SCRIPT_MODE_FILE)
  set(commit unknown)
  find_program(git git)
  if(git)
    execute_process(
      COMMAND ${git} -c safe.directory=* describe --always --abbrev=12 --exclude=* --dirty
      WORKING_DIRECTORY ${SOURCE}
      OUTPUT_VARIABLE described
      RESULT_VARIABLE failed
      OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
    if(NOT failed)
      set(commit ${described})
    endif()
  endif()
  file(CONFIGURE OUTPUT ${HEADER} @ONLY CONTENT [[
#pragma once

// The commit of this build; written by cmake/commit.cmake.

#include <string_view>

namespace harpoon {

inline constexpr std::string_view kCommit = "@commit@";

}  // namespace harpoon
]])
  return()
endif()

set(commit_header ${PROJECT_BINARY_DIR}/include/generated/commit.hpp)
add_custom_target(harpoon_commit_header
  COMMAND ${CMAKE_COMMAND} -DSOURCE=${PROJECT_SOURCE_DIR} -DHEADER=${commit_header}
          -P ${CMAKE_CURRENT_LIST_FILE}
  BYPRODUCTS ${commit_header}
  COMMENT "")
add_dependencies(generated harpoon_commit_header)

add_library(harpoon_commit INTERFACE)
target_include_directories(harpoon_commit INTERFACE ${PROJECT_BINARY_DIR}/include)
add_dependencies(harpoon_commit harpoon_commit_header)
