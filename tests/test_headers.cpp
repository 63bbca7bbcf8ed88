// What all tests include (tests/CMakeLists.txt).
