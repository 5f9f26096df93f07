# What `cmake --install` puts where: the program, the libraries with their headers, the ready scenes, and the
# package files with which another project writes
#
#   find_package(galet REQUIRED)                       #include <galet/galet.hpp>
#   target_link_libraries(mine PRIVATE galet::galet)
#
# Headers keep their places relative to the repository root, below include/galet: they include each other as
# "common/...", "md/...", "cd/...", "src/...", inside the repository and outside.
if(NOT PROJECT_IS_TOP_LEVEL OR NOT GALET_BUILD_STUDIES)
  return()
endif()
include(CMakePackageConfigHelpers)

install(TARGETS galet RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS galet_common galet_md galet_cd galet_galet EXPORT galet_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})

foreach(folder common md cd src)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/${folder} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/galet
    FILES_MATCHING PATTERN "*.hpp" PATTERN "galet.hpp" EXCLUDE PATTERN "commands" EXCLUDE)
endforeach()
install(FILES ${PROJECT_SOURCE_DIR}/src/galet.hpp DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/galet)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/galet)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/src/data/ DESTINATION ${CMAKE_INSTALL_DATADIR}/galet)
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/galet)
install(EXPORT galet_targets NAMESPACE galet:: FILE galetTargets.cmake DESTINATION ${package_dir})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/galetConfig.cmake.in
  ${PROJECT_BINARY_DIR}/galetConfig.cmake INSTALL_DESTINATION ${package_dir})
# Before version 1 a minor version may break what uses it.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/galetConfigVersion.cmake
  VERSION ${PROJECT_VERSION} COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/galetConfig.cmake ${PROJECT_BINARY_DIR}/galetConfigVersion.cmake
  DESTINATION ${package_dir})
