# Tests of the repository itself: the rules of the tree, and the installed package used from outside.
# The rules look at the sources, which are the same in every preset: once is enough.
if(NOT GALET_SANITIZE)
  foreach(rule engines openmp length paths once)
    add_test(NAME structure.${rule} COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/structure/check.sh ${rule})
  endforeach()
  add_test(NAME structure.self_test COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/structure/self_test.sh)
endif()
add_test(NAME structure.kernels
         COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/structure/kernels.sh $<TARGET_OBJECTS:galet_md> $<TARGET_OBJECTS:galet_cd>
                 COMMAND_EXPAND_LISTS)

# The installed libraries carry no sanitizer or coverage flags: an outside project links them only without.
if(PROJECT_IS_TOP_LEVEL AND GALET_BUILD_STUDIES AND NOT GALET_SANITIZE AND NOT GALET_COVERAGE)
  add_test(NAME package.outside_project
    COMMAND sh ${CMAKE_CURRENT_SOURCE_DIR}/package/run.sh ${CMAKE_COMMAND} ${PROJECT_BINARY_DIR} ${CMAKE_GENERATOR}
            ${CMAKE_CXX_COMPILER})
  set_tests_properties(package.outside_project PROPERTIES TIMEOUT 300)
endif()
