# What modules are linked with (conchoid_module in rooms.cmake): nobody who links the library needs it.
# Empty for what is left out.
set(CONCHOID_PICTURE_LIBRARIES)
set(CONCHOID_VDB_LIBRARIES)
set(CONCHOID_LEARNING_LIBRARIES)
set(CONCHOID_MPI_LIBRARIES)
if(CONCHOID_WITH_PICTURES)
  conchoid_find(embree 3)
  conchoid_find(PNG)
  set(CONCHOID_PICTURE_LIBRARIES embree PNG::PNG)
endif()

if(CONCHOID_WITH_VDB)  # Imath: half numbers of OpenVDB
  conchoid_external(openvdb LIBRARIES openvdb Imath HEADER openvdb/openvdb.h LINKS TBB::tbb)
  set(CONCHOID_VDB_LIBRARIES conchoid_external::openvdb)
endif()

if(CONCHOID_WITH_LEARNING)
  conchoid_find(HDF5 COMPONENTS CXX)
  if(NOT TARGET conchoid_external::hdf5)
    set(conchoid_hdf5 ${HDF5_CXX_LIBRARIES})
    list(FILTER conchoid_hdf5 INCLUDE REGEX "/libhdf5[^/]*$")  # not what HDF5 itself was linked with
    add_library(conchoid_external::hdf5 INTERFACE IMPORTED)
    target_include_directories(conchoid_external::hdf5 SYSTEM INTERFACE ${HDF5_CXX_INCLUDE_DIRS})
    target_link_libraries(conchoid_external::hdf5 INTERFACE ${conchoid_hdf5})
  endif()
  # Debian's xgboost-config.cmake asks for the xgboost program, which is another package.
  conchoid_external(xgboost LIBRARIES xgboost HEADER xgboost/c_api.h)
  set(CONCHOID_LEARNING_LIBRARIES conchoid_external::hdf5 conchoid_external::xgboost)
endif()

if(CONCHOID_WITH_MPI)
  conchoid_find(MPI COMPONENTS CXX)
  set(CONCHOID_MPI_LIBRARIES MPI::MPI_CXX)
endif()
