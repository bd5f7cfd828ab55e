// SPDX-License-Identifier: Apache-2.0
#pragma once

// The two single-header libraries, with the same switches in every file that includes them. Their
// code is compiled in third_party.cpp. tinygltf decodes no image: it would trust the sizes in them.
#define TINYGLTF_NO_STB_IMAGE
#define TINYGLTF_NO_STB_IMAGE_WRITE
#include <tiny_gltf.h>

// glTF has only PNG and JPEG. Other decoders would only add attack surface.
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_HDR
#define STBI_NO_STDIO
#define STBI_MAX_DIMENSIONS 16384
#define STBI_WRITE_NO_STDIO
#if __has_include(<stb_image.h>)
#include <stb_image.h>
#include <stb_image_write.h>
#else
#include <stb/stb_image.h>
#include <stb/stb_image_write.h>
#endif
