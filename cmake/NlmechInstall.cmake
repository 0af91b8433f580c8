# `cmake --install build --prefix DIR`: library with its headers, programs, and what the programs read at run time. Then
#     find_package(nlmech COMPONENTS geodesy)
#     target_link_libraries(mine PRIVATE nlmech::geodesy)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/nlmech)
install(EXPORT nlmech NAMESPACE nlmech:: FILE nlmechTargets.cmake DESTINATION ${package_dir})
if(TARGET nlmech_ivp)
  set(NLMECH_PACKAGE_NEEDS_EIGEN TRUE)
else()
  set(NLMECH_PACKAGE_NEEDS_EIGEN FALSE)
endif()
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/nlmechConfig.cmake.in ${PROJECT_BINARY_DIR}/nlmechConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
# Only a new major version may break interfaces.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/nlmechConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/nlmechConfig.cmake ${PROJECT_BINARY_DIR}/nlmechConfigVersion.cmake
        DESTINATION ${package_dir})

if(NLMECH_CHAPTERS_SELECTED)
  set(data_dir ${CMAKE_INSTALL_DATADIR}/nlmech)
  install(FILES ${PROJECT_SOURCE_DIR}/figures/style.gp DESTINATION ${data_dir}/figures)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/figures/templates DESTINATION ${data_dir}/figures)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/tables/published DESTINATION ${data_dir}/tables)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/tables/errata DESTINATION ${data_dir}/tables)
  install(FILES ${PROJECT_SOURCE_DIR}/tables/places.csv DESTINATION ${data_dir}/tables)
endif()
