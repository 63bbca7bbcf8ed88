tenku_test(solver
  FILES solver_hard_test.cpp solver_lamp_test.cpp solver_node_test.cpp solver_room_test.cpp
  LINK core scene visibility illuminance radiosity)
target_include_directories(test_solver PRIVATE ${PROJECT_SOURCE_DIR}/tests)
