# A component of ESP-IDF: REQUIRES pinhole, then #include <pinhole/render.h>. RISC-V has kernels of its own, Xtensa has none.
file(GLOB sources "${CMAKE_CURRENT_LIST_DIR}/core/fx/*.c" "${CMAKE_CURRENT_LIST_DIR}/core/geom/*.c"
    "${CMAKE_CURRENT_LIST_DIR}/core/render/*.c" "${CMAKE_CURRENT_LIST_DIR}/core/effects/*.c"
    "${CMAKE_CURRENT_LIST_DIR}/core/kernels/portable/*.c")
if(CONFIG_IDF_TARGET_ARCH_RISCV)
    set(kernels core/kernels/rv32)
    file(GLOB own "${CMAKE_CURRENT_LIST_DIR}/${kernels}/*.c" "${CMAKE_CURRENT_LIST_DIR}/${kernels}/*.S")
    foreach(file IN LISTS own)
        get_filename_component(name "${file}" NAME_WE)
        list(REMOVE_ITEM sources "${CMAKE_CURRENT_LIST_DIR}/core/kernels/portable/${name}.c")
    endforeach()
endif()
idf_component_register(SRCS ${sources} ${own} INCLUDE_DIRS include
    PRIV_INCLUDE_DIRS ${kernels} core/kernels/portable core core/render core/kernels core/fx)
target_compile_options(${COMPONENT_LIB} PRIVATE -O3)
