# A component of ESP-IDF: REQUIRES pinhole, then #include <pinhole/render.h>. No kernel is written for Xtensa or for RISC-V
# yet: the portable ones are compiled.
file(GLOB sources "${CMAKE_CURRENT_LIST_DIR}/core/fx/*.c" "${CMAKE_CURRENT_LIST_DIR}/core/geom/*.c"
    "${CMAKE_CURRENT_LIST_DIR}/core/render/*.c" "${CMAKE_CURRENT_LIST_DIR}/core/effects/*.c"
    "${CMAKE_CURRENT_LIST_DIR}/core/kernels/portable/*.c")
idf_component_register(SRCS ${sources} INCLUDE_DIRS include
    PRIV_INCLUDE_DIRS core/kernels/portable core core/render core/kernels core/fx)
target_compile_options(${COMPONENT_LIB} PRIVATE -O3)
