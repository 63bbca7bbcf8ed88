"use strict";
// The same rule as the program's own splat buffer: round discs on the screen whose depth is a
// shallow cone on the plane of their surface, cut at the borders of the surface.
const kDisc = {cone: 0.5, steep: 16, overlap: 1.5, least: 0.6, seam: 0.02, reach: 1.5};
const kPointShader = `#version 300 es
precision highp float;
precision highp int;
layout(location=0) in uvec4 aPlace;
layout(location=1) in ivec2 aNormal;
layout(location=2) in uvec4 aBorders;
layout(location=3) in uint aColour;
uniform vec3 uOrigin, uStep, uRight, uDown, uForward;
uniform vec2 uFrom, uSize, uCoarsest;
uniform float uPixel, uMargin, uTexels, uLargest, uGrow;
flat out vec4 vDisc;
flat out vec4 vDepth;
flat out vec3 vBorder0, vBorder1;
flat out uint vColour;
const float kCone = ${kDisc.cone.toFixed(3)}, kSteep = ${kDisc.steep.toFixed(3)},
            kOverlap = ${kDisc.overlap.toFixed(3)}, kLeast = ${kDisc.least.toFixed(3)},
            kSeam = ${kDisc.seam.toFixed(3)}, kReach = ${kDisc.reach.toFixed(3)};
vec3 normalOf(vec2 e) {
  vec3 n = vec3(e, 1.0 - abs(e.x) - abs(e.y));
  if (n.z < 0.0) n.xy = (1.0 - abs(n.yx)) * vec2(n.x < 0.0 ? -1.0 : 1.0, n.y < 0.0 ? -1.0 : 1.0);
  return normalize(n);
}
vec3 border(vec3 n, vec3 d, float depth, float footprint, uint turn, uint far) {
  if (far == 0u) return vec3(0.0, 0.0, 1.0);
  float sign = n.z < 0.0 ? -1.0 : 1.0, a = -1.0 / (sign + n.z), b = n.x * n.y * a;
  vec3 tangent = vec3(1.0 + sign * n.x * n.x * a, sign * b, -sign * n.x);
  vec3 bitangent = vec3(b, sign + n.y * n.y * a, -n.y);
  float angle = float(turn) * (6.283185307179586 / 256.0);
  vec3 inward = cos(angle) * tangent + sin(angle) * bitangent;
  vec3 on = d - (float(far - 1u) * (kReach / 254.0) * footprint) * inward;
  vec3 plane = cross(on, cross(n, inward));
  if (dot(plane, inward) < 0.0) plane = -plane;
  vec2 ab = uPixel * vec2(dot(plane, uRight), dot(plane, uDown));
  return vec3(ab, dot(plane, d) / depth) / length(ab) + vec3(0.0, 0.0, kSeam);
}
void main() {
  gl_Position = vec4(2.0, 2.0, 2.0, 1.0);
  gl_PointSize = 1.0;
  vec3 d = uOrigin + uStep * vec3(aPlace.xyz);
  float depth = dot(d, uForward);
  if (!(depth > 1e-4)) return;
  bool isEdge = (aPlace.w & 1u) != 0u;
  float footprint = exp2((float(aPlace.w >> 1) - 1.0) / 512.0 - 20.0);
  float shown = uGrow * footprint, size = shown / (uPixel * depth);
  if (size > (isEdge ? uCoarsest.y : uCoarsest.x)) return;
  vec3 n = normalOf(vec2(aNormal) / 32767.0);
  float above = dot(n, d);
  if (above >= 0.0) return;
  vec2 at = vec2(dot(d, uRight), dot(d, uDown)) / (depth * uPixel) - uFrom;
  float radius = min(0.5 * max(kLeast, kOverlap * size), uLargest);
  if (any(lessThan(at + radius, vec2(0.0))) || any(greaterThan(at - radius, uSize))) return;
  float nearness = 1.0 / depth, turned = shown * nearness * nearness;
  vDisc = vec4(at, radius * radius, nearness);
  vDepth = vec4(uPixel * dot(n, uRight) / above, uPixel * dot(n, uDown) / above, kSteep * turned,
                kCone * turned / (radius * radius));
  vBorder0 = vBorder1 = vec3(0.0, 0.0, 1.0);
  if (isEdge) {
    vBorder0 = border(n, d, depth, footprint, aBorders.x, aBorders.y);
    vBorder1 = border(n, d, depth, footprint, aBorders.z, aBorders.w);
  }
  vColour = aColour;
  gl_Position = vec4((at + uMargin) * 2.0 / (uSize + 2.0 * uMargin) - 1.0, 0.0, 1.0);
  // The four samples of a pixel lie a quarter of a texel off the middles of their texels.
  gl_PointSize = 2.0 * radius * uTexels + (uTexels > 1.0 ? 0.5 : 0.0);
}`;
const kSamplePlaces = `
const vec2 kPlaces[4] =
    vec2[4](vec2(0.375, 0.125), vec2(0.875, 0.375), vec2(0.125, 0.625), vec2(0.625, 0.875));
`;
const kDiscShader = `#version 300 es
precision highp float;
precision highp int;
flat in vec4 vDisc;
flat in vec4 vDepth;
flat in vec3 vBorder0, vBorder1;
flat in uint vColour;
uniform float uMargin, uTexels;
layout(location=0) out uint oColour;
${kSamplePlaces}
void main() {
  vec2 place = gl_FragCoord.xy - uMargin * uTexels;
  if (uTexels > 1.0) {
    ivec2 texel = ivec2(gl_FragCoord.xy);
    place = floor(0.5 * gl_FragCoord.xy) - uMargin + kPlaces[(texel.y & 1) * 2 + (texel.x & 1)];
  }
  vec2 off = place - vDisc.xy;
  float square = dot(off, off);
  if (square > vDisc.z || dot(vBorder0.xy, off) + vBorder0.z <= 0.0 ||
      dot(vBorder1.xy, off) + vBorder1.z <= 0.0) discard;
  float slope = clamp(dot(vDepth.xy, off), -vDepth.z, vDepth.z);
  gl_FragDepth = clamp(0.01 * max(vDisc.w + slope - vDepth.w * square, 1e-9), 0.0, 1.0);
  oColour = vColour;
}`;
const kScreenTriangle = `#version 300 es
void main() {
  gl_Position = vec4(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0, 0.0, 1.0);
}`;
const kShowShader = `#version 300 es
precision highp float;
precision highp int;
precision highp usampler2D;
uniform usampler2D uItems, uSky;
uniform sampler2D uMap;
uniform vec3 uRight, uDown, uCorner, uBelow;
uniform float uPixel, uExposure;
uniform vec3 uScale;
uniform int uMargin, uTexels, uHeight, uFalse, uFill;
out vec4 oColour;
${kSamplePlaces}
const uint kNothing = 0xffffffffu;
vec3 colourOf(uint code) {
  return vec3(code & 511u, (code >> 9) & 511u, (code >> 18) & 511u) *
         exp2(float(code >> 27) - 24.0);
}
vec3 sky(vec2 pixel) {
  vec3 ray = normalize(uCorner + uPixel * (pixel.x * uRight + pixel.y * uDown));
  if (ray.z < 0.0) return uBelow;
  ivec2 size = textureSize(uSky, 0);
  float azimuth = atan(ray.x, ray.y) / 6.283185307179586;
  float x = (azimuth - floor(azimuth)) * float(size.x);
  float y = atan(ray.z, length(ray.xy)) / 1.5707963267948966 * float(size.y - 1);
  int row = clamp(int(y), 0, max(0, size.y - 2)), column = int(x);
  vec2 part = vec2(x - floor(x), clamp(y - float(row), 0.0, 1.0));
  int next = min(row + 1, size.y - 1), left = column % size.x, right = (column + 1) % size.x;
  return mix(mix(colourOf(texelFetch(uSky, ivec2(left, row), 0).r),
                 colourOf(texelFetch(uSky, ivec2(right, row), 0).r), part.x),
             mix(colourOf(texelFetch(uSky, ivec2(left, next), 0).r),
                 colourOf(texelFetch(uSky, ivec2(right, next), 0).r), part.x), part.y);
}
vec3 screen(vec3 light) {
  vec3 x = uExposure * light;
  vec3 shown = clamp(x * (2.51 * x + 0.03) / (x * (2.43 * x + 0.59) + 0.14), 0.0, 1.0);
  return mix(12.92 * shown, 1.055 * pow(shown, vec3(1.0 / 2.4)) - 0.055,
             step(0.0031308, shown));
}
vec3 falseColour(vec3 light) {
  float value = dot(light, vec3(0.2126, 0.7152, 0.0722));
  float place = uScale.z > 0.0 ? log(max(value, uScale.x) / uScale.x) / log(uScale.y / uScale.x)
                               : (value - uScale.x) / (uScale.y - uScale.x);
  int last = textureSize(uMap, 0).x - 1;
  return texelFetch(uMap, ivec2(int(clamp(place, 0.0, 1.0) * float(last) + 0.5), 0), 0).rgb;
}
// Where points are left out a pixel may stay empty: with three of four beside it on a surface, it
// is on it.
uint filled(ivec2 texel) {
  uint found = kNothing;
  int empty = 0;
  for (int k = 0; k < 4; ++k) {
    int step = 2 * (k & 1) - 1;
    uint code = texelFetch(uItems, texel + (k < 2 ? ivec2(step, 0) : ivec2(0, step)), 0).r;
    if (code == kNothing) ++empty;
    else found = code;
  }
  return empty > 1 ? kNothing : found;
}
void main() {
  ivec2 pixel = ivec2(int(gl_FragCoord.x), uHeight - 1 - int(gl_FragCoord.y));
  vec3 sum = vec3(0.0);
  for (int s = 0; s < uTexels * uTexels; ++s) {
    ivec2 texel = (pixel + uMargin) * uTexels + ivec2(s % uTexels, s / uTexels);
    uint code = texelFetch(uItems, texel, 0).r;
    if (uFill != 0 && code == kNothing) code = filled(texel);
    vec2 place = vec2(pixel) + (uTexels > 1 ? kPlaces[s] : vec2(0.5));
    sum += code == kNothing ? sky(place) : colourOf(code);
  }
  sum /= float(uTexels * uTexels);
  oColour = vec4(uFalse != 0 ? falseColour(sum) : screen(sum), 1.0);
}`;
