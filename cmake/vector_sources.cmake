# harpoon_vector_sources(FILE...): marks sources with SIMD kernels for several instruction sets.
#
# Under the address sanitizer they are compiled without optimisation: checking fully inlined vector
# code takes a compiler minutes a file, and finds nothing that the plain form does not. g++'s note
# that vectors are passed otherwise than by GCC 4.6 is silenced: they never leave their file.
function(harpoon_vector_sources)
  set(options -Wno-psabi)
  if(HARPOON_SANITIZE MATCHES "address")
    list(APPEND options -O0)
  endif()
  set_source_files_properties(${ARGN} PROPERTIES COMPILE_OPTIONS "${options}")
endfunction()
