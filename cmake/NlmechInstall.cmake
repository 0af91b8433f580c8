# `cmake --install build --prefix DIR`: library with its headers, programs, and what the programs read at run time. Then
#     find_package(nlmech COMPONENTS geodesy)
#     target_link_libraries(mine PRIVATE nlmech::geodesy)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/nlmech)
install(EXPORT nlmech NAMESPACE nlmech:: FILE nlmechTargets.cmake DESTINATION ${package_dir})
# The packages that a program needs which links a component, read off the targets: what is linked as <package>::<target>, by the
# component or by one that it uses.
function(nlmech_packages_behind component out)
  set(packages "")
  set(waiting ${component})
  set(seen "")
  while(waiting)
    list(POP_FRONT waiting next)
    list(APPEND seen ${next})
    get_target_property(links nlmech_${next} INTERFACE_LINK_LIBRARIES)
    foreach(link IN LISTS links)
      string(REGEX REPLACE "^.<LINK_ONLY:(.*)>$" "\\1" link "${link}")
      if(link MATCHES "^nlmech::(.*)$")
        if(NOT CMAKE_MATCH_1 IN_LIST seen)
          list(APPEND waiting ${CMAKE_MATCH_1})
        endif()
      elseif(link MATCHES "^([A-Za-z0-9_]+)::")
        list(APPEND packages ${CMAKE_MATCH_1})
      endif()
    endforeach()
  endwhile()
  list(REMOVE_DUPLICATES packages)
  set(${out} ${packages} PARENT_SCOPE)
endfunction()

get_property(installed GLOBAL PROPERTY NLMECH_INSTALLED)
set(NLMECH_PACKAGES "set(nlmech_COMPONENTS ${installed})\n")
foreach(component IN LISTS installed)
  nlmech_packages_behind(${component} packages)
  string(APPEND NLMECH_PACKAGES "set(nlmech_packages_${component} ${packages})\n")
endforeach()
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/nlmechConfig.cmake.in ${PROJECT_BINARY_DIR}/nlmechConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
# Only a new major version may break interfaces.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/nlmechConfigVersion.cmake COMPATIBILITY SameMajorVersion)
install(FILES ${PROJECT_BINARY_DIR}/nlmechConfig.cmake ${PROJECT_BINARY_DIR}/nlmechConfigVersion.cmake
        DESTINATION ${package_dir})

# For builds without CMake, a file a component: c++ -std=c++20 mine.cpp $(pkg-config --cflags --libs nlmech-geodesy). The library
# is static, so that what a component links is required of everyone.
set(pkgconfig_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
file(RELATIVE_PATH up /${pkgconfig_dir} /)
string(REGEX REPLACE "/$" "" up "${up}")
set(pkgconfig_fmt fmt)
set(pkgconfig_Eigen3 eigen3)
set(pkgconfig_Boost "")  # headers where every compiler looks
foreach(component IN LISTS installed)
  get_target_property(links nlmech_${component} INTERFACE_LINK_LIBRARIES)
  set(requires "")
  foreach(link IN LISTS links)
    string(REGEX REPLACE "^.<LINK_ONLY:(.*)>$" "\\1" link "${link}")
    if(link MATCHES "^nlmech::(.*)$")
      list(APPEND requires nlmech-${CMAKE_MATCH_1})
    elseif(link MATCHES "^([A-Za-z0-9_]+)::")
      if(NOT DEFINED pkgconfig_${CMAKE_MATCH_1})
        message(FATAL_ERROR "nlmech::${component}: what does pkg-config call ${CMAKE_MATCH_1}? Please add it to NlmechInstall.cmake")
      endif()
      list(APPEND requires ${pkgconfig_${CMAKE_MATCH_1}})
    endif()
  endforeach()
  list(REMOVE_DUPLICATES requires)
  list(JOIN requires ", " requires)
  configure_file(${CMAKE_CURRENT_LIST_DIR}/nlmech.pc.in ${PROJECT_BINARY_DIR}/generated/pkgconfig/nlmech-${component}.pc @ONLY)
  install(FILES ${PROJECT_BINARY_DIR}/generated/pkgconfig/nlmech-${component}.pc DESTINATION ${pkgconfig_dir})
endforeach()

if(NLMECH_CHAPTERS_SELECTED)
  set(data_dir ${CMAKE_INSTALL_DATADIR}/nlmech)
  install(FILES ${PROJECT_SOURCE_DIR}/figures/style.gp ${PROJECT_SOURCE_DIR}/figures/curves.xml
          DESTINATION ${data_dir}/figures)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/figures/templates DESTINATION ${data_dir}/figures)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/tables/published DESTINATION ${data_dir}/tables)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/chapters/integrators/examples DESTINATION ${data_dir}/chapters/integrators)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/chapters/homotopy/frames DESTINATION ${data_dir}/chapters/homotopy)
  install(FILES ${PROJECT_SOURCE_DIR}/tables/reference/problem_set.csv
                ${PROJECT_SOURCE_DIR}/tables/reference/problem_set_conditions.csv
                ${PROJECT_SOURCE_DIR}/tables/reference/method_times.csv
                ${PROJECT_SOURCE_DIR}/tables/reference/bvp_test_set.csv
                ${PROJECT_SOURCE_DIR}/tables/reference/bvp_test_set_times.csv DESTINATION ${data_dir}/tables/reference)
  install(FILES ${PROJECT_SOURCE_DIR}/tables/places.csv DESTINATION ${data_dir}/tables)
endif()
