// studio/tests/bridge.cpp: request() for tests: reads requests from standard input and writes replies to standard
// output. Each is preceded by a line with the sizes of its JSON and of its bytes, in decimal.
#include "studio/bridge.h"

#include <cstdio>
#include <string>

int main() {
    std::size_t json_size = 0;
    std::size_t bytes_size = 0;
    while (std::scanf("%zu %zu", &json_size, &bytes_size) == 2 && std::getchar() == '\n') {
        std::string json(json_size, '\0');
        std::string bytes(bytes_size, '\0');
        if (std::fread(json.data(), 1, json_size, stdin) != json_size) return 1;
        if (std::fread(bytes.data(), 1, bytes_size, stdin) != bytes_size) return 1;
        const sikku::Reply reply = sikku::request(json, bytes);
        std::printf("%zu %zu\n", reply.json.size(), reply.bytes.size());
        std::fwrite(reply.json.data(), 1, reply.json.size(), stdout);
        std::fwrite(reply.bytes.data(), 1, reply.bytes.size(), stdout);
        std::fflush(stdout);
    }
    return 0;
}
