# Packages of the web build, under the names that find_package() gives them elsewhere. Debian's libraries that consist
# of headers alone serve both builds; oneTBB and zlib have stand-ins in studio/wasm/include.
set(web_headers ${PROJECT_BINARY_DIR}/headers)
file(MAKE_DIRECTORY ${web_headers})
# One folder with these alone: /usr/include itself has the headers of another C library.
foreach(name glm fmt boost nlohmann fast_float toml++)
    if(NOT EXISTS /usr/include/${name})
        message(FATAL_ERROR "missing: /usr/include/${name}; ./demo --studio installs it")
    endif()
    file(CREATE_LINK /usr/include/${name} ${web_headers}/${name} SYMBOLIC)
endforeach()

foreach(target glm::glm fmt::fmt Boost::headers TBB::tbb ZLIB::ZLIB nlohmann_json::nlohmann_json)
    add_library(${target} INTERFACE IMPORTED GLOBAL)
    target_include_directories(${target} SYSTEM INTERFACE ${web_headers} ${PROJECT_SOURCE_DIR}/studio/wasm/include)
endforeach()
target_compile_definitions(fmt::fmt INTERFACE FMT_HEADER_ONLY)
set(tomlplusplus_INCLUDE_DIR ${web_headers} CACHE PATH "")

# find_package() finds an empty module of each, as the targets are there.
foreach(name glm fmt Boost TBB ZLIB nlohmann_json)
    file(WRITE ${PROJECT_BINARY_DIR}/packages/Find${name}.cmake "set(${name}_FOUND TRUE)\n")
endforeach()
list(PREPEND CMAKE_MODULE_PATH ${PROJECT_BINARY_DIR}/packages)

# Sizes have 32 bits; what may be larger is checked against the memory.
add_compile_options(-fwasm-exceptions -Wno-shorten-64-to-32)
