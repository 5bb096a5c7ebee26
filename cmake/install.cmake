# Installs the library (all rooms behind the one target conchoid::conchoid), its headers and the program.
include(CMakePackageConfigHelpers)
include(GNUInstallDirs)

get_property(rooms GLOBAL PROPERTY CONCHOID_ROOMS)
add_library(conchoid_library INTERFACE)
set_target_properties(conchoid_library PROPERTIES EXPORT_NAME conchoid)
target_link_libraries(conchoid_library INTERFACE ${rooms})
add_library(conchoid::conchoid ALIAS conchoid_library)

set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/conchoid)
install(TARGETS conchoid_library conchoid_settings ${rooms} EXPORT conchoidTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT conchoidTargets NAMESPACE conchoid:: DESTINATION ${package_folder})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/conchoid DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.hpp")
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/conchoidConfig.cmake.in conchoidConfig.cmake
                              INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(conchoidConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_SOURCE_DIR}/cmake/dependencies.cmake DESTINATION ${package_folder} RENAME conchoidDependencies.cmake)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/conchoidConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/conchoidConfigVersion.cmake
        DESTINATION ${package_folder})
