// The look of the report's own pictures (render/shading), so that a colour means the same in both: the value is interpolated and its
// colour looked up per pixel, soft neutral lights are fixed to the camera, backs of plain surfaces are paler.
import { ClampToEdgeWrapping, Color, DataTexture, DoubleSide, LinearFilter, RGBAFormat, ShaderMaterial, SRGBColorSpace } from "three";

export const clay = new Color("#eeedea");   // surface_color of render/draw_mesh.h

// Three lights fixed to the camera, as in render/shading/shading_style.h.
const looks = `
const float ambient = 0.05, wrap = 0.1, exposure_of_values = 1.1, silhouette = 0.62, dark_line = 0.45;
const vec3 back_tint = vec3(0.58, 0.68, 0.85);
float one_light(vec3 n, vec3 towards, float strength) {
    return strength / (1.0 + wrap) * max(0.0, dot(n, normalize(towards)) + wrap);
}
float light_on(vec3 n) {
    return ambient + one_light(n, vec3(-0.45, 0.62, 0.64), 0.78) + one_light(n, vec3(0.80, 0.10, 0.59), 0.12)
                   + one_light(n, vec3(0.05, -0.35, 0.94), 0.18);
}
// 1 on a thin line of a hatch, else 0; along is +1 or -1.
float hatch(float along) { return step(mod(gl_FragCoord.x + along * gl_FragCoord.y, 6.0), 1.4); }
`;

const vertexShader = `
attribute float sharpness;
#ifdef HAS_VALUES
attribute float place;
#ifdef HAS_UNDEFINED
attribute float _defined;
#endif
varying float v_place, v_known;
#endif
varying float v_sharp;
varying vec3 v_smooth, v_at;
void main() {
    vec4 at = modelViewMatrix * vec4(position, 1.0);
    v_at = at.xyz;
    v_sharp = sharpness;
    v_smooth = (1.0 - sharpness) * normalize(normalMatrix * normal);
#ifdef HAS_VALUES
#ifdef HAS_UNDEFINED
    v_known = _defined;
#else
    v_known = 1.0;
#endif
    v_place = v_known * place;
#endif
    gl_Position = projectionMatrix * at;
}`;

const fragmentShader = `
uniform vec3 plain;
#ifdef HAS_VALUES
uniform sampler2D palette;
uniform float paletteSize;
uniform vec3 undefinedColor;
uniform bool isPlain;
uniform float light_on_values;
varying float v_place, v_known;
#else
const bool isPlain = true;
#endif
varying float v_sharp;
varying vec3 v_smooth, v_at;
${looks}
void main() {
    vec3 across = cross(dFdx(v_at), dFdy(v_at));
    vec3 face = length(across) > 0.0 ? normalize(across) : vec3(0.0, 0.0, 1.0);   // turned to the viewer
    vec3 n = v_sharp * face + (gl_FrontFacing ? v_smooth : -v_smooth);
    n = length(n) > 0.0 ? normalize(n) : face;
    float light = light_on(n);
    vec3 color = plain * min(1.0, light) * (gl_FrontFacing ? vec3(1.0) : back_tint);
#ifdef HAS_VALUES
    float t = clamp(v_place / max(v_known, 1e-6), 0.0, 1.0);
    vec3 looked_up = texture2D(palette, vec2((t * (paletteSize - 1.0) + 0.5) / paletteSize, 0.5)).rgb;
    if (v_known < 0.5) looked_up = undefinedColor * (1.0 - 0.35 * hatch(-1.0));
    else if (!gl_FrontFacing) looked_up *= 1.0 - dark_line * hatch(1.0);
    if (!isPlain) color = looked_up * (1.0 - light_on_values * (1.0 - min(1.0, exposure_of_values * light)));
#endif
    float pixels = abs(n.z) / max(fwidth(n.z), 1e-6);   // from where the surface turns away
    color *= 1.0 - silhouette * clamp(1.5 - pixels, 0.0, 1.0);
    gl_FragColor = vec4(min(color, 1.0), 1.0);
    #include <colorspace_fragment>
}`;

export function paletteOf(colors) {
    const bytes = Uint8Array.from(colors.flatMap((c) => [1, 3, 5].map((at) => parseInt(c.slice(at, at + 2), 16)).concat(255)));
    const texture = new DataTexture(bytes, colors.length, 1, RGBAFormat);
    texture.colorSpace = SRGBColorSpace;
    texture.minFilter = texture.magFilter = LinearFilter;
    texture.wrapS = texture.wrapT = ClampToEdgeWrapping;
    texture.needsUpdate = true;
    return texture;
}

/// @param value  of the model's extras; null: a surface of the colour `plain`
export function materialFor(value, hasUndefined, plain) {
    const defines = {}, uniforms = { plain: { value: plain } };
    if (value) {
        defines.HAS_VALUES = "";
        if (hasUndefined) defines.HAS_UNDEFINED = "";
        uniforms.palette = { value: paletteOf(value.colors) };
        uniforms.paletteSize = { value: value.colors.length };
        uniforms.undefinedColor = { value: new Color(value.undefined_color) };
        uniforms.isPlain = { value: false };
        uniforms.light_on_values = { value: 0.09 };
    }
    return new ShaderMaterial({ vertexShader, fragmentShader, defines, uniforms, side: DoubleSide });
}
