#include "tests/solid_reader.h"

namespace sikku {

ReadMesh read_stl(const std::string& bytes) {
    ReadMesh mesh;
    std::map<std::tuple<float, float, float>, std::uint32_t> numbers;
    constexpr std::size_t head = 84, record = 50;
    const auto count = number_at<std::uint32_t>(bytes, 80);
    EXPECT_EQ(bytes.size(), head + record * count);
    EXPECT_NE(bytes.substr(0, 5), "solid");
    for (std::size_t i = 0; i < count; ++i) {
        const auto vector = [&](std::size_t k) {
            const std::size_t at = head + record * i + 12 * k;
            return glm::vec3(number_at<float>(bytes, at), number_at<float>(bytes, at + 4),
                             number_at<float>(bytes, at + 8));
        };
        auto& triangle = mesh.triangles.emplace_back();
        std::array<glm::dvec3, 3> corners;
        for (std::size_t k = 0; k < 3; ++k) {
            const glm::vec3 point = vector(k + 1);
            corners[k] = point;
            const auto [known, is_new] =
                numbers.emplace(std::tuple(point.x, point.y, point.z), static_cast<std::uint32_t>(numbers.size()));
            if (is_new) mesh.points.emplace_back(point);
            triangle[k] = known->second;
        }
        // The normal is computed from the corners in the file, to the last bit of a float.
        const glm::vec<3, long double> a(corners[0]), b(corners[1]), c(corners[2]);
        const auto across = glm::cross(b - a, c - a);
        const long double length = std::sqrt(glm::dot(across, across));
        EXPECT_GT(length, 0);
        constexpr double half_digit = 0x1p-25;  // of numbers from 0.5 to 1
        for (int k = 0; k < 3; ++k) {
            EXPECT_NEAR(vector(0)[k], static_cast<double>(across[k] / length), 1.001 * half_digit) << i;
        }
        EXPECT_EQ(number_at<std::uint16_t>(bytes, head + record * i + 48), 0);
    }
    return mesh;
}

ReadMesh read_glb_mesh(const std::string& bytes, nlohmann::json* json_of) {
    ReadMesh mesh;
    const auto length = number_at<std::uint32_t>(bytes, 12);
    const auto json = nlohmann::json::parse(bytes.substr(20, length));
    const std::string binary = bytes.substr(28 + length);
    std::map<std::size_t, std::size_t> first;  // point of each accessor
    const auto view = [&](const nlohmann::json& accessor) {
        return json["bufferViews"][accessor["bufferView"].get<std::size_t>()]["byteOffset"].get<std::size_t>();
    };
    for (const auto& primitive : json["meshes"][0]["primitives"]) {
        const auto number = primitive["attributes"]["POSITION"].get<std::size_t>();
        const auto& positions = json["accessors"][number];
        if (first.emplace(number, mesh.points.size()).second) {
            for (std::size_t i = 0; i < positions["count"].get<std::size_t>(); ++i) {
                const std::size_t at = view(positions) + 12 * i;
                mesh.points.emplace_back(number_at<float>(binary, at), number_at<float>(binary, at + 4),
                                         number_at<float>(binary, at + 8));
            }
        }
        const auto& corners = json["accessors"][primitive["indices"].get<std::size_t>()];
        for (std::size_t i = 0; i < corners["count"].get<std::size_t>(); i += 3) {
            auto& triangle = mesh.triangles.emplace_back();
            for (std::size_t k = 0; k < 3; ++k) {
                triangle[k] = static_cast<std::uint32_t>(first[number]) +
                              number_at<std::uint32_t>(binary, view(corners) + 4 * (i + k));
            }
            mesh.materials.push_back(primitive["material"].get<std::size_t>());
        }
    }
    if (json_of) *json_of = json;
    return mesh;
}

ReadMesh read_obj_mesh(const std::string& text) {
    ReadMesh mesh;
    std::istringstream lines(text);
    std::map<std::string, std::size_t> materials;
    std::size_t material = 0;
    for (std::string line; std::getline(lines, line);) {
        std::istringstream words(line);
        std::string key, name;
        words >> key;
        if (key == "v") {
            glm::dvec3 point;
            words >> point.x >> point.y >> point.z;
            mesh.points.push_back(point);
        } else if (key == "usemtl") {
            words >> name;
            material = materials.emplace(name, materials.size()).first->second;
        } else if (key == "f") {
            auto& triangle = mesh.triangles.emplace_back();
            for (std::uint32_t& corner : triangle) {
                words >> corner;
                --corner;
            }
            mesh.materials.push_back(material);
        }
    }
    return mesh;
}

void expect_closed(const ReadMesh& mesh) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::size_t> triangle_at;
    for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
        for (std::size_t k = 0; k < 3; ++k) {
            const std::pair edge(mesh.triangles[t][k], mesh.triangles[t][(k + 1) % 3]);
            ASSERT_NE(edge.first, edge.second);
            ASSERT_TRUE(triangle_at.emplace(edge, t).second) << "an edge is used twice in the same direction";
        }
    }
    std::vector<std::size_t> degree(mesh.points.size());
    std::vector<std::pair<std::uint32_t, std::uint32_t>> first(mesh.points.size());
    for (const auto& [edge, triangle] : triangle_at) {
        ASSERT_TRUE(triangle_at.contains({edge.second, edge.first})) << "an edge is open";
        ++degree[edge.first];
        first[edge.first] = edge;
    }
    for (std::size_t point = 0; point < mesh.points.size(); ++point) {
        if (degree[point] == 0) continue;
        std::size_t turned = 0;
        auto edge = first[point];
        do {
            const auto& corners = mesh.triangles[triangle_at.at(edge)];
            const auto k =
                static_cast<std::size_t>(std::find(corners.begin(), corners.end(), edge.first) - corners.begin());
            edge.second = corners[(k + 2) % 3];
            ++turned;
        } while (edge != first[point] && turned <= degree[point]);
        ASSERT_EQ(turned, degree[point]) << "surfaces touch at a corner";
    }
}

}  // namespace sikku
