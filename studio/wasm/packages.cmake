# Packages of the web build, under the names that find_package() gives them elsewhere. Debian's header-only libraries
# serve both builds; studio/wasm/include replaces zlib.
set(web_headers ${PROJECT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${web_headers})
# A folder with only these headers: /usr/include contains the headers of another C library.
foreach(name glm fmt boost nlohmann fast_float toml++)
    if(NOT EXISTS /usr/include/${name})
        message(FATAL_ERROR "missing: /usr/include/${name}; run ./demo --studio to install it")
    endif()
    file(CREATE_LINK /usr/include/${name} ${web_headers}/${name} SYMBOLIC)
endforeach()

foreach(target glm::glm fmt::fmt Boost::headers ZLIB::ZLIB nlohmann_json::nlohmann_json)
    add_library(${target} INTERFACE IMPORTED GLOBAL)
    target_include_directories(${target} SYSTEM INTERFACE ${web_headers} ${PROJECT_SOURCE_DIR}/studio/wasm/include)
endforeach()
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)
set(tomlplusplus_INCLUDE_DIR ${web_headers} CACHE PATH "")

# The targets exist already, so find_package() finds an empty module for each.
foreach(name glm fmt Boost ZLIB nlohmann_json)
    file(WRITE ${PROJECT_BINARY_DIR}/packages/Find${name}.cmake "set(${name}_FOUND TRUE)\n")
endforeach()
list(PREPEND CMAKE_MODULE_PATH ${PROJECT_BINARY_DIR}/packages)

add_compile_options(-fwasm-exceptions)
