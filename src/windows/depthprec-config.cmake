# SPDX-License-Identifier: MIT
# CMake, with the folder of this file as depthprec_DIR:
#     find_package(depthprec CONFIG REQUIRED)
#     target_link_libraries(game PRIVATE depthprec::depthprec)
# depthprec.dll has to lie beside game.exe.
if(NOT TARGET depthprec::depthprec)
    add_library(depthprec::depthprec SHARED IMPORTED)
    set_target_properties(depthprec::depthprec PROPERTIES
        INTERFACE_INCLUDE_DIRECTORIES "${CMAKE_CURRENT_LIST_DIR}/include"
        IMPORTED_LOCATION "${CMAKE_CURRENT_LIST_DIR}/depthprec.dll"
        IMPORTED_IMPLIB "${CMAKE_CURRENT_LIST_DIR}/depthprec.lib")
endif()
