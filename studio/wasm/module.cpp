// studio/wasm/module.cpp: request() for JavaScript; see studio/npm/bridge.ts.
#include "studio/bridge.h"

#include <emscripten.h>

namespace {
sikku::Reply reply;
}

extern "C" {

EMSCRIPTEN_KEEPALIVE void sikku_request(const char* json, std::size_t json_size, const char* bytes,
                                        std::size_t bytes_size) {
    reply = {};
    reply = sikku::request({json, json_size}, {bytes, bytes_size});
}
EMSCRIPTEN_KEEPALIVE const char* sikku_json() {
    return reply.json.data();
}
EMSCRIPTEN_KEEPALIVE std::size_t sikku_json_size() {
    return reply.json.size();
}
EMSCRIPTEN_KEEPALIVE const char* sikku_bytes() {
    return reply.bytes.data();
}
EMSCRIPTEN_KEEPALIVE std::size_t sikku_bytes_size() {
    return reply.bytes.size();
}

}  // extern "C"
