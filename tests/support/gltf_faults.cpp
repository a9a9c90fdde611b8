// Faults of cameras, lights, materials, skins, instances and compressed data: each a construct with some of its text
// replaced.
#include <stdexcept>

#include "tests/support/gltf_constructs.h"
#include "tests/support/gltf_hostile.h"

namespace umbrameter::test {
namespace {

struct Patch {
  std::string_view construct;
  std::string_view from;
  std::string_view to;
};

// The JSON chunk of a GLB, some of it replaced, and a GLB of that.
Bytes patched(const Bytes& file, const Patch& patch) {
  std::size_t length = 0;
  for (std::size_t i = 4; i-- > 0;) length = (length << 8u) | file[12 + i];
  const auto split = file.begin() + 20 + static_cast<std::ptrdiff_t>(length);
  std::string json(file.begin() + 20, split);
  const std::size_t at = json.find(patch.from);
  if (at == std::string::npos) throw std::logic_error("no such text: " + std::string(patch.from));
  json.replace(at, patch.from.size(), patch.to);
  return pack_glb(json, split == file.end() ? Bytes() : Bytes(split + 8, file.end()));
}

const std::vector<Patch>& patches() {
  static const std::vector<Patch> all = {
      {"a camera without a far plane", "\"yfov\":0.9", "\"yfov\":4"},
      {"a camera without a far plane", "\"znear\":0.125", "\"znear\":0"},
      {"a camera under a scaled node", "\"zfar\":50", "\"zfar\":0.1"},
      {"a camera under a scaled node", "\"type\":\"perspective\"", "\"name\":\"eye\",\"type\":\"perspective\""},
      {"a camera at an animated node", "{\"camera\":0", "{\"scale\":[0,0,0],\"camera\":0"},
      {"a mask that repeats by default", "\"MASK\"", "\"BLEND\""},
      {"a mask that repeats by default", "\"MASK\"", "\"OPAQUE\""},
      {"a mask that repeats by default", "\"MASK\"", "\"HOLES\""},
      {"a mask that repeats by default", "\"source\":0", "\"name\":\"t\""},
      {"a mask that repeats by default", "{\"source\":0}", "{\"source\":0},{\"source\":0,\"sampler\":3}"},
      {"a mask that repeats by default", "\"pbrMetallicRoughness\":{",
       "\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,1],"},
      {"a mask that repeats by default", "\"pbrMetallicRoughness\":{",
       "\"pbrMetallicRoughness\":{\"baseColorFactor\":[1,1,1,-1],"},
      {"a mask that repeats by default", "\"pbrMetallicRoughness\":{",
       "\"pbrMetallicRoughness\":{\"baseColorFactor\":[1e300,1,1,1],"},
      {"a turned mask", "\"offset\":[0,1]", "\"offset\":[0]"},
      {"a turned mask", "\"offset\":[0,1]", "\"offset\":[1e300,0]"},
      {"a turned mask", "\"offset\":[0,1]", "\"offset\":[3e38,0]"},
      {"specular", "\"specularFactor\":0.5", "\"specularFactor\":-1"},
      {"specular", "[1,0.5,2]", "[1,0.5]"},
      {"specular", "[1,0.5,2]", "[1,1e300,1]"},
      {"specular glossiness", "\"glossinessFactor\":0.75", "\"glossinessFactor\":-1"},
      {"a mask in a diffuse texture", "\"diffuseTexture\":{\"index\":0}",
       R"("diffuseTexture":{"index":0,"texCoord":0,"extensions":{"KHR_texture_transform":{"rotation":1}}})"},
      {"a mask in a diffuse texture", "\"diffuseTexture\":{\"index\":0}", "\"diffuseTexture\":{}"},
      {"a mask in a diffuse texture", "\"diffuseTexture\":{\"index\":0}",
       R"("diffuseTexture":{"index":0,"extensions":{}})"},
      {"meshopt with 16-bit triangles", "\"ATTRIBUTES\"", "\"OTHERS\""},
      {"meshopt with 16-bit triangles", "\"byteStride\":12,\"count\":8", "\"byteStride\":96,\"count\":1"},
      {"meshopt with 16-bit triangles", "\"byteStride\":12,\"count\":8", "\"byteStride\":2,\"count\":48"},
      {"meshopt with 16-bit triangles", "\"byteStride\":2,\"count\":18", "\"byteStride\":1,\"count\":36"},
      {"meshopt with 16-bit triangles", "\"byteStride\":2,\"count\":18", "\"byteStride\":4,\"count\":9"},
      {"meshopt with 16-bit triangles", "\"byteLength\":96,", "\"byteLength\":24000000,"},
      {"meshopt with 16-bit triangles", "\"mode\":\"TRIANGLES\"", "\"mode\":\"TRIANGLES\",\"filter\":\"OCTAHEDRAL\""},
      {"meshopt with 16-bit triangles", "\"mode\":\"ATTRIBUTES\"", "\"mode\":\"ATTRIBUTES\",\"filter\":\"QUATERNION\""},
      {"meshopt with 16-bit triangles", "\"mode\":\"ATTRIBUTES\"", "\"mode\":\"ATTRIBUTES\",\"filter\":\"OCTAHEDRAL\""},
      {"meshopt with 16-bit triangles", "\"mode\":\"ATTRIBUTES\"", "\"mode\":\"ATTRIBUTES\",\"filter\":\"LINEAR\""},
      {"meshopt with 16-bit triangles", "\"mode\":\"ATTRIBUTES\"", "\"mode\":\"ATTRIBUTES\",\"filter\":\"NONE\""},
      {"meshopt with 16-bit triangles", "\"mode\":\"TRIANGLES\"", "\"mode\":\"ATTRIBUTES\""},
      {"a skin", "\"JOINTS_0\":1", "\"JOINTS_0\":2"},
      {"a skin", "\"WEIGHTS_0\":2", "\"WEIGHTS_0\":4"},
      {"a skin", ",\"WEIGHTS_0\":2", ""},
      {"a skin", "\"joints\":[2,3]", "\"joints\":[2]"},
      {"a skin", "\"joints\":[2,3]", "\"joints\":[2,3,3]"},
      {"a skin", "\"joints\":[2,3]", "\"joints\":[]"},
      {"a skin", "\"children\":[1,2]", "\"children\":[1]"},
      {"a skin", "\"indices\":", "\"mode\":0,\"indices\":"},
      {"a skin without bind matrices", "\"componentType\":5126,\"count\":8,\"bufferView\":2",
       "\"componentType\":5126,\"count\":8"},
      {"instances by all three", "\"count\":3", "\"count\":2"},
      {"instances by all three", "\"attributes\":{\"TRANSLATION\"", "\"attributes\":{\"_OTHER\""},
      {"instances by translation", "\"attributes\":{\"TRANSLATION\":2}", "\"attributes\":{}"},
      {"instances by rotation and scale", "\"attributes\":{\"ROTATION\":2", "\"attributes\":{\"ROTATION\":3"},
      {"Draco with edgebreaker and normals", "\"NORMAL\":1}}}", "\"NORMAL\":99}}}"},
      {"Draco with edgebreaker and normals", "\"NORMAL\":1}}}", "\"NORMAL\":-1}}}"},
      {"Draco with edgebreaker and normals", "\"attributes\":{\"POSITION\":0,\"NORMAL\":1},", "\"attributes\":{},"},
      {"Draco with edgebreaker and normals", "{\"bufferView\":0,\"attributes\"",
       "{\"bufferView\":\"0\",\"attributes\""},
      {"Draco with edgebreaker and normals", "{\"bufferView\":0,\"attributes\"", "{\"attributes\""},
      {"Draco in sequence", "\"POSITION\":0}}}", "\"TEXCOORD_0\":0}}}"},
      {"Draco with a skin in sequence", "\"WEIGHTS_0\":2}}}", "\"WEIGHTS_0\":9}}}"},
      {"Draco with a skin in sequence", ",\"WEIGHTS_0\":2}}}", "}}}"},
      {"Draco with a skin in sequence", "\"joints\":[1,2]", "\"joints\":[1]"},
      {"morph targets with weights of the mesh", "\"targets\":[{\"POSITION\":0}",
       "\"targets\":[{\"POSITION\":0,\"NORMAL\":0}"},
      {"morph targets with weights of the mesh", "\"targets\":[{\"POSITION\":0}", "\"targets\":[{\"POSITION\":3}"},
      {"morph targets with weights of the mesh", "\"count\":8,\"bufferView\":0", "\"count\":7,\"bufferView\":0"},
      {"a skin", "\"count\":8,\"bufferView\":2", "\"count\":7,\"bufferView\":2"},
      {"a skin", "\"count\":8,\"bufferView\":1", "\"count\":7,\"bufferView\":1"},
      {"meshopt with 16-bit triangles",
       "\"byteLength\":36,\"extensions\":{\"EXT_meshopt_compression\":{\"buffer\":0,\"byteOffset\":84,\"byteLength\":"
       "29,"
       "\"byteStride\":2,\"count\":18",
       "\"byteLength\":34,\"extensions\":{\"EXT_meshopt_compression\":{\"buffer\":0,\"byteOffset\":84,\"byteLength\":"
       "29,"
       "\"byteStride\":2,\"count\":17"},
      {"triangle strip", "\"count\":5", "\"count\":2"},
      {"triangle strip without indices", "\"count\":5", "\"count\":2"},
      {"triangles without indices", "\"mode\":4", "\"mode\":9"},
      {"triangles without indices", "\"POSITION\":0", "\"POSITION\":0,\"COLOR_0\":0"},
      {"sparse positions over a buffer view", "\"sparse\":{\"count\":2", "\"sparse\":{\"count\":9"},
      {"sparse positions over a buffer view", "\"componentType\":5121", "\"componentType\":5126"},
      {"sparse positions over a buffer view", "\"sparse\":{\"count\":2", "\"sparse\":{\"count\":0"},
      {"interleaved attributes", "\"byteStride\":28", "\"byteStride\":8"},
      {"a scene by name", "\"scene\":1", "\"scene\":-1"},
      {"translation, rotation and scale", "\"scale\":[1.5,0.5,2]", "\"scale\":[1.5,0.5]"},
      {"translation, rotation and scale", "\"scale\":[1.5,0.5,2]", "\"matrix\":[1,0,0,1,0,1,0,0,0,0,1,0,0,0,0,1]"},
      {"names and extras", "\"extras\":[1,2]", "\"extras\":{\"name\":\"part\"}"},
      {"names and extras", "\"extras\":[1,2]", "\"extras\":{\"name\":7}"},
      {"8-bit indices", "\"componentType\":5121", "\"componentType\":5120"},
      {"8-bit indices", "\"indices\":1", "\"indices\":1,\"mode\":-1"},
      {"8-bit indices", "\"indices\":1", "\"indices\":-2"},
      {"8-bit indices", "\"indices\":1", "\"indices\":1e14"},
      {"8-bit indices", "\"nodes\":[0]", "\"nodes\":[-7]"},
      {"8-bit indices", "\"mesh\":0", "\"mesh\":0,\"rotation\":[0,0,1e300,1e300]"},
      {"8-bit indices", "\"primitives\"",
       "\"name\":\"a name that goes on and on and is longer than anything that fits into a message\",\"primitives\""},
      {"8-bit indices", "\"count\":18", "\"count\":17,\"name\":\"seventeen\""},
      {"sparse positions over a buffer view", "\"sparse\":{\"count\":2", "\"sparse\":{\"count\":-1"},
      {"sparse positions over a buffer view", "\"componentType\":5121}", "\"componentType\":5121,\"byteOffset\":1}"},
      {"sparse positions over a buffer view", "\"values\":{", "\"values\":{\"byteOffset\":4,"},
      {"a camera without a far plane", "\"matrix\":[", "\"scale\":[-1,1,1],\"x\":["},
      {"a mirrored node", "\"mesh\":0,", "\"mesh\":0,\"camera\":0,"},
      {"a mask in a diffuse texture", "\"diffuseTexture\":{\"index\":0}", "\"diffuseTexture\":{\"texCoord\":0}"},
      {"a mask in a diffuse texture", "[0.5,1,1,0.7]", "7"},
      {"a mask in a diffuse texture", "[0.5,1,1,0.7]", "[0.5,1,1]"},
      {"a mask in a diffuse texture", "[0.5,1,1,0.7]", "[0.5,1,1,-1]"},
      {"a mask in a diffuse texture", "[0.5,1,1,0.7]", "[0.5,1,1,1e300]"},
      {"a mask that repeats by default", "\"textures\":[{\"source\":0}]",
       R"("samplers":[{"wrapS":33071}],"textures":[{"source":0},{"source":0},{"source":0,"sampler":0}])"
       R"(,"images":[{"bufferView":0}],"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}},)"
       R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":1}}},)"
       R"({"pbrMetallicRoughness":{"baseColorTexture":{"index":2}}}],"x":[0])"},
      {"meshopt with 16-bit triangles", "\"byteStride\":2,\"count\":18", "\"byteStride\":2,\"count\":17"},
      {"meshopt with 16-bit triangles", "\"byteLength\":36,", "\"byteLength\":34,"},
      {"an image in a folder", "textures/gr%C3%BCn.png", "%2"},
      {"an image in a folder", "textures/gr%C3%BCn.png", "%zz/%1z/%z1"},
      {"an image in a folder", "textures/gr%C3%BCn.png", ""},
      {"an image in a folder", "textures/gr%C3%BCn.png", "%00"},
      {"an image in a folder", "textures/gr%C3%BCn.png", "../a.png"},
      {"an image in a folder", "textures/gr%C3%BCn.png", "/a.png"},
      {"an image in a folder", "textures/gr%C3%BCn.png", "%5Ca.png"},
      {"an image in a folder", "textures/gr%C3%BCn.png", "http://a/b.png"},
      {"an image in a folder", "textures/gr%C3%BCn.png", "a/b:c.png"},
      {"an image in a folder", "textures/gr%C3%BCn.png", "data:image/png;base64,===="},
      {"an image in a folder", "textures/gr%C3%BCn.png", "data:image/png,abc"},
      {"an image in a folder", "textures/gr%C3%BCn.png", "data:,x;base64,abc"},
      {"a skin", "\"WEIGHTS_0\":2", "\"WEIGHTS_0\":2,\"JOINTS_1\":1"},
      {"a skin", "\"WEIGHTS_0\":2", "\"WEIGHTS_0\":0"},
      {"a skin with normals", "\"skin\":0", "\"skin\":9"},
      {"a skin with normals", "{\"matrix\":[", "{\"scale\":[1e-200,1,1],\"x\":["},
      {"a skin with normals", "{\"matrix\":[", "{\"scale\":[0,1,1],\"x\":["},
      {"morph targets with weights of the mesh", "\"weights\":[0.5,1]", "\"weights\":[0,1,2,3]"},
      {"morph targets with weights of the mesh", "\"targets\":[{\"POSITION\":0}", "\"targets\":[{\"NORMAL\":0}"},
      {"8-bit indices", "\"asset\":{", "\"extensionsUsed\":[\"ACME_a\",\"ACME_b\"],\"asset\":{"},
      {"8-bit indices", "\"asset\":{", "\"extensionsRequired\":[\"KHR_materials_sheen\"],\"asset\":{"},
  };
  return all;
}

/// A node with a light, and its JSON.
Bytes lit(const std::string& light) {
  GltfBuilder builder;
  use(builder, "KHR_lights_punctual");
  add_solid(builder);
  add(builder, "nodes", R"({"mesh":0,"scale":[1,-1,2],"extensions":{"KHR_lights_punctual":{"light":0}}})");
  builder.more = R"(,"extensions":{"KHR_lights_punctual":{"lights":[)" + light + "]}}";
  return to_binary_gltf(builder);
}

Bytes seen_by(const std::string& camera) {
  GltfBuilder builder;
  add_solid(builder);
  add(builder, "cameras", R"({"type":"orthographic","orthographic":)" + camera + "}");
  add(builder, "nodes", R"({"mesh":0,"camera":0})");
  return to_binary_gltf(builder);
}

}  // namespace

std::vector<HostileFile> faulty_files() {
  std::vector<HostileFile> files;
  const std::vector<Construct> constructs = all_constructs();
  for (const Patch& patch : patches()) {
    for (const Construct& construct : constructs) {
      if (construct.name != patch.construct) continue;
      files.push_back({construct.name + ": " + std::string(patch.to), patched(construct.file, patch)});
    }
  }
  for (const Construct& construct : constructs) {
    if (construct.name != "Draco in sequence" && construct.name != "Draco with metadata") continue;
    // The compressed bytes come first in the binary chunk.
    std::size_t length = 0;
    for (std::size_t i = 4; i-- > 0;) length = (length << 8u) | construct.file[12 + i];
    for (std::size_t at = 28 + length; at < construct.file.size(); ++at) {
      Bytes bytes = construct.file;
      bytes[at] = 0xff;
      files.push_back({construct.name + " with a byte of 255 at " + std::to_string(at), bytes});
    }
  }
  for (const char* light :
       {R"({"type":"spot","spot":{"innerConeAngle":-1}})", R"({"type":"spot","spot":{"outerConeAngle":0}})",
        R"({"type":"spot","spot":{"outerConeAngle":2}})", R"({"type":"point","intensity":-1})",
        R"({"type":"spot","spot":{"innerConeAngle":1,"outerConeAngle":0.5}})", R"({"type":"point","range":-1})",
        R"({"type":"point","range":1e999})", R"({"type":"point","color":[1]})", R"({"type":"point","color":[-1,0,0]})",
        R"({"type":"point","color":[0,-1,0]})", R"({"type":"directional","color":[0,0,-1]})"}) {
    files.push_back({light, lit(light)});
  }
  for (const char* camera : {R"({"xmag":0,"ymag":1,"znear":0,"zfar":9})", R"({"xmag":1,"ymag":0,"znear":0,"zfar":9})",
                             R"({"xmag":1,"ymag":1,"znear":-1,"zfar":9})", R"({"xmag":1,"ymag":1,"znear":3,"zfar":2})",
                             R"({"xmag":-1,"ymag":1,"znear":0,"zfar":9})"}) {
    files.push_back({camera, seen_by(camera)});
  }
  return files;
}

}  // namespace umbrameter::test
