// SPDX-License-Identifier: GPL-2.0-or-later
// Shaders of pictures/renderer.py (GLSL 3.3). Positions in metres in the world frame; colours in sRGB, 0..1.

//// SOLID_VERTEX PLAIN_VERTEX
uniform mat4 camera;
uniform mat4 sun;
uniform vec3 light;        // unit vector to the light
uniform vec2 ambient;      // brightness of faces that look up and down
uniform float direct;      // brightness added by the light
uniform vec4 toward;       // plane: distance behind the front of the house is toward.w - dot(toward.xyz, place)
uniform vec2 haziness;     // largest share of haze, distance at which it is reached [m]
in vec3 place;
in vec3 normal;
in vec3 color;
flat out vec3 vColor;      // without the light
flat out vec3 vLit;        // added by the light
out float vFar;            // share of haze, not limited
out vec3 vShade;
void main() {
  vColor = color * mix(ambient.y, ambient.x, 0.5 + 0.5 * normal.z);
  vLit = color * direct * max(dot(normal, light), 0.0);
  vFar = haziness.x * (toward.w - dot(toward.xyz, place)) / haziness.y;
  vShade = (sun * vec4(place + 0.03 * normal, 1.0)).xyz * 0.5 + 0.5;  // offset [m] against shadows of a face on itself
  gl_Position = camera * vec4(place, 1.0);
}

//// SOLID_FRAGMENT PLAIN_FRAGMENT
uniform sampler2DShadow shade;
uniform vec3 haze;  // colour
uniform vec2 haziness;
flat in vec3 vColor;
flat in vec3 vLit;
in float vFar;
in vec3 vShade;
out vec4 picture;
void main() {
#ifdef PLAIN  // without shadows
  vec3 color = vColor + vLit;
#else
  vec3 color = vColor + vLit * texture(shade, vShade);
#endif
  picture = vec4(mix(color, haze, clamp(vFar, 0.0, haziness.x)), 1.0);
}

//// EDGE_VERTEX
uniform mat4 camera;
uniform vec4 eye;     // position [m] and 1, or direction to it and 0
uniform vec4 toward;  // as for SOLID
uniform vec2 haziness;
in vec3 place;
out float vFar;
void main() {
  vec3 near = place + 0.012 * normalize(eye.xyz - eye.w * place);  // [m] in front of the faces that it separates
  vFar = haziness.x * clamp((toward.w - dot(toward.xyz, place)) / haziness.y, 0.0, 1.0);
  gl_Position = camera * vec4(near, 1.0);
}

//// EDGE_GEOMETRY
layout(lines) in;
layout(triangle_strip, max_vertices = 4) out;
uniform vec2 size;    // of the picture [pixel]
uniform float width;  // of a line [pixel]
in float vFar[];
out float vHaze;
out float vAside;  // distance from the middle of the line [pixel]
void main() {
  vec4 a = gl_in[0].gl_Position, b = gl_in[1].gl_Position;
  if (a.w <= 0.0 || b.w <= 0.0) return;  // behind the viewer
  vec2 along = (b.xy / b.w - a.xy / a.w) * size;
  vec2 across = vec2(-along.y, along.x) / max(length(along), 1e-4) * (width + 1.0) / size;
  for (int k = 0; k < 4; k++) {
    vec4 end = k < 2 ? a : b;
    vHaze = vFar[k / 2];
    vAside = (k % 2 == 0 ? 0.5 : -0.5) * (width + 1.0);
    gl_Position = vec4(end.xy + (k % 2 == 0 ? across : -across) * end.w, end.zw);
    EmitVertex();
  }
  EndPrimitive();
}

//// EDGE_FRAGMENT
uniform vec4 ink;  // colour and opacity
uniform vec3 haze;
uniform float width;
in float vHaze;
in float vAside;
out vec4 picture;
void main() {
  float soft = clamp(0.5 * width + 0.5 - abs(vAside), 0.0, 1.0);
  picture = vec4(mix(ink.rgb, haze, vHaze), ink.a * soft);
}

//// SHADOW_VERTEX
uniform mat4 sun;
in vec3 place;
void main() { gl_Position = sun * vec4(place, 1.0); }

//// SHADOW_FRAGMENT
void main() {}

//// GROUND_VERTEX SHADE_VERTEX
uniform mat4 camera;
uniform mat4 sun;
uniform vec4 bounds;  // of the part that is drawn: west, south, east, north [m]
in vec2 corner;       // 0 or 1
out vec2 place;
out vec3 vShade;
void main() {
  place = mix(bounds.xy, bounds.zw, corner);
  vec4 world = vec4(place, 0.0, 1.0);
  vShade = (sun * world).xyz * 0.5 + 0.5;
  gl_Position = camera * world;
}

//// GROUND_FRAGMENT
uniform float reach;  // distance up to which the grid is seen [m]
uniform vec2 middle;  // of the ground [m]
in vec2 place;
out vec4 picture;
float lines(vec2 p, vec2 width) {  // width: of a pixel
  vec2 near = abs(fract(p - 0.5) - 0.5) / width;
  vec2 shown = clamp(1.3 - 1.4 * near, 0.0, 1.0) * clamp(1.5 - 3.0 * width, 0.0, 1.0);
  return max(shown.x, shown.y);
}
void main() {
  vec2 width = max(fwidth(place), 1e-6);
  float grid = max(0.16 * lines(place, width), 0.26 * lines(0.2 * place, 0.2 * width));
  vec3 color = mix(vec3(0.84, 0.83, 0.78), vec3(0.45, 0.46, 0.44), grid);
  picture = vec4(color, 1.0 - smoothstep(0.2 * reach, reach, length(place - middle)));
}

//// SHADE_FRAGMENT
uniform sampler2DShadow shade;
in vec3 vShade;
out vec4 picture;
void main() {
  bool inside = all(greaterThan(vShade, vec3(0.0))) && all(lessThan(vShade, vec3(1.0)));
  picture = vec4(0.0, 0.0, 0.0, inside ? 0.34 * (1.0 - texture(shade, vShade)) : 0.0);
}

//// SKY_VERTEX
in vec2 corner;
out float height;
void main() {
  height = 0.5 + 0.5 * corner.y;
  gl_Position = vec4(corner, 0.9999, 1.0);
}

//// SKY_FRAGMENT
uniform vec3 horizon;
uniform vec3 zenith;
in float height;
out vec4 picture;
void main() { picture = vec4(mix(horizon, zenith, smoothstep(0.5, 1.0, height)), 1.0); }

//// MARK_VERTEX
uniform mat4 camera;
uniform float size;  // [pixel] at distance 1
uniform vec2 sizes;  // smallest and largest [pixel]
in vec3 place;
in float state;      // 1 partly broken, 2 broken, 3 broken before the start
flat out float vState;
void main() {
  vState = state;
  gl_Position = camera * vec4(place, 1.0);
  gl_PointSize = clamp(size / gl_Position.w, sizes.x, sizes.y);
  gl_Position.z -= 0.004 * gl_Position.w;  // in front of the members that the joint connects
}

//// MARK_FRAGMENT
uniform float opacity;
uniform vec3 partly;
uniform vec3 broken;
flat in float vState;
out vec4 picture;
float cross2(vec2 p) {
  p = abs(vec2(p.x + p.y, p.x - p.y) * 0.7071);
  return min(max(p.x - 0.78, p.y - 0.2), max(p.y - 0.78, p.x - 0.2));
}
float triangle(vec2 p) { return max(abs(p.x) * 0.866 - p.y * 0.5 - 0.36, p.y - 0.5); }
void main() {
  vec2 p = gl_PointCoord * 2.0 - 1.0;
  float inside = vState < 1.5 ? triangle(p) : vState < 2.5 ? cross2(p) : length(p) - 0.55;
  float soft = fwidth(p.x) * 0.75 + 0.001;
  vec3 color = vState < 1.5 ? partly : vState < 2.5 ? broken : vec3(1.0);
  vec3 rim = vState > 1.5 && vState < 2.5 ? vec3(1.0) : vec3(0.08);
  float width = vState < 2.5 ? 0.16 : 0.28;
  float alpha = 1.0 - smoothstep(width - soft, width + soft, inside);
  if (alpha < 0.02) discard;
  picture = vec4(mix(color, rim, smoothstep(-soft, soft, inside)), alpha * opacity);
}
