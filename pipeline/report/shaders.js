// How a quad becomes a sphere, a bond or the droplet: each pixel finds the surface that it sees, or the cut through it. view.js draws
// them. The view is parallel along z; lengths are those of the file.
'use strict';
const CUT = `
  uniform vec4 plane; uniform float depth; uniform float picking; varying vec3 vColour; varying vec3 vId;
  void finish(vec3 colour, vec3 normal, float z) {
    gl_FragDepthEXT = clamp(0.5 - 0.5 * z / depth, 0.0, 1.0);
    float light = 0.42 + 0.5 * max(0.0, dot(normal, normalize(vec3(-0.4, 0.7, 0.8)))) + 0.16 * max(0.0, dot(normal, vec3(0.7, -0.3, 0.5)));
    gl_FragColor = picking > 0.5 ? vec4(vId, 1.0) : vec4(colour * light, 1.0);
  }`;
const SPHERE = {
  vertexShader: `
    attribute vec3 place; attribute float size; attribute vec3 tint; attribute vec3 number;
    uniform vec3 centre; uniform float scale; uniform mat3 turn; uniform vec2 half_;
    varying vec3 vColour; varying vec3 vId; varying vec3 vCentre; varying float vRadius; varying vec2 vAt;
    void main() {
      vColour = tint; vId = number; vCentre = turn * (place - centre); vRadius = size * scale; vAt = position.xy;
      gl_Position = vec4((vCentre.xy + position.xy * vRadius) / half_, 0.0, 1.0);
    }`,
  fragmentShader: CUT + `
    varying vec3 vCentre; varying float vRadius; varying vec2 vAt;
    void main() {
      float s = 1.0 - dot(vAt, vAt);
      if (s < 0.0) discard;
      vec3 normal = vec3(vAt, sqrt(s)), at = vCentre + vRadius * normal, back = vCentre + vRadius * vec3(vAt, -normal.z);
      if (dot(plane.xyz, at) > plane.w) {
        if (plane.z <= 0.0 || dot(plane.xyz, back) > plane.w) discard;
        at.z = (plane.w - dot(plane.xy, at.xy)) / plane.z;
        finish(vColour * 0.85, plane.xyz, at.z);
      } else finish(vColour, normal, at.z);
    }`};
const BOND = {
  vertexShader: `
    attribute vec3 start; attribute vec3 end; attribute vec3 tint; attribute vec3 number;
    uniform vec3 centre; uniform float thick; uniform mat3 turn; uniform vec2 half_;
    varying vec3 vColour; varying vec3 vId; varying vec3 vAxis; varying float vAcross; varying vec3 vSide;
    void main() {
      vec3 a = turn * (start - centre), b = turn * (end - centre), along = b - a;
      vec2 across = vec2(-along.y, along.x);
      float flat_ = length(across);
      vSide = flat_ > 1e-6 ? vec3(across / flat_, 0.0) : vec3(1.0, 0.0, 0.0);
      vAcross = position.x; vAxis = position.y < 0.0 ? a : b; vColour = tint; vId = number;
      gl_Position = vec4((vAxis + vSide * thick * position.x).xy / half_, 0.0, 1.0);
    }`,
  fragmentShader: CUT + `
    uniform float thick; varying vec3 vAxis; varying float vAcross; varying vec3 vSide;
    void main() {
      float up = sqrt(max(0.0, 1.0 - vAcross * vAcross));
      vec3 at = vAxis + thick * (vSide * vAcross + vec3(0.0, 0.0, up));
      if (dot(plane.xyz, at) > plane.w) discard;
      finish(vColour, normalize(vSide * vAcross + vec3(0.0, 0.0, up)), at.z);
    }`};
const DROPLET = {
  vertexShader: SPHERE.vertexShader,
  fragmentShader: `
    varying vec3 vColour; varying vec2 vAt;
    void main() {
      float s = dot(vAt, vAt);
      if (s > 1.0) discard;
      gl_FragColor = vec4(vColour, 0.06 + 0.4 * pow(s, 8.0));
    }`};
