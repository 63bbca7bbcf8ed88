/// One channel of a picture that was read back.
#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "pictures/picture_codec.h"

namespace tenku::testing_support {

/// @return [row][column]; empty, and the test fails, if there is no such channel
inline std::vector<float> channel(const StoredPicture& picture, const std::string& name) {
  const auto& names = picture.header.channels;
  const auto found = std::find(names.begin(), names.end(), name);
  std::vector<float> values;
  EXPECT_NE(found, names.end()) << name;
  if (found == names.end()) return values;
  for (auto i = static_cast<std::size_t>(found - names.begin()); i < picture.values.size();
       i += names.size()) {
    values.push_back(picture.values[i]);
  }
  return values;
}

}  // namespace tenku::testing_support
