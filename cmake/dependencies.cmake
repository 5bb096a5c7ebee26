# What the library is linked with. Read when conchoid is built and again, from the installed package, when a program is built
# with it: so no path of the one machine gets to the other. The reader
# defines conchoid_find(PACKAGE …), which finds a package or gives up, and conchoid_missing(TEXT), which gives up.

# conchoid_external(NAME LIBRARIES one or more HEADER file): libraries without a usable CMake package become the target
# conchoid_external::NAME.
macro(conchoid_external name)
  cmake_parse_arguments(EXTERNAL "" "HEADER" "LIBRARIES;LINKS" ${ARGN})
  if(NOT TARGET conchoid_external::${name})
    set(external_paths)
    foreach(external_library ${EXTERNAL_LIBRARIES})
      find_library(CONCHOID_LIBRARY_${external_library} ${external_library})
      mark_as_advanced(CONCHOID_LIBRARY_${external_library})
      if(NOT CONCHOID_LIBRARY_${external_library})
        conchoid_missing("the library ${external_library} was not found; install it or set CMAKE_PREFIX_PATH")
      endif()
      list(APPEND external_paths ${CONCHOID_LIBRARY_${external_library}})
    endforeach()
    find_path(CONCHOID_HEADER_${name} ${EXTERNAL_HEADER})
    mark_as_advanced(CONCHOID_HEADER_${name})
    if(NOT CONCHOID_HEADER_${name})
      conchoid_missing("the header ${EXTERNAL_HEADER} was not found; install it or set CMAKE_PREFIX_PATH")
    endif()
    add_library(conchoid_external::${name} INTERFACE IMPORTED)
    target_include_directories(conchoid_external::${name} SYSTEM INTERFACE ${CONCHOID_HEADER_${name}})
    target_link_libraries(conchoid_external::${name} INTERFACE ${external_paths} ${EXTERNAL_LINKS})
  endif()
endmacro()

conchoid_find(Eigen3 NO_MODULE)
conchoid_find(TBB)
conchoid_find(fmt)
conchoid_find(BLAS)
conchoid_find(LAPACK)
conchoid_find(nlohmann_json)
conchoid_find(tomlplusplus)
conchoid_external(qhull LIBRARIES qhull_r HEADER libqhull_r/libqhull_r.h)
