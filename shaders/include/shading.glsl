// Light on surfaces: a warm key light with Phong highlights (Phong 1975), a sky that lights from above more than from
// below, and a rim where grazing surfaces mirror that sky (Schlick 1994). Linear RGB.
#ifndef SHADING_GLSL
#define SHADING_GLSL

const vec3 KEY_LIGHT = vec3(1.02, 0.97, 0.88);
const vec3 SKY_LIGHT = vec3(0.60, 0.67, 0.76);
const vec3 GROUND_LIGHT = vec3(0.30, 0.29, 0.28);

vec3 ambient_light(vec3 normal) { return mix(GROUND_LIGHT, SKY_LIGHT, 0.5 + 0.5 * normal.y); }

struct Gloss {
    float specular; // strength of the highlight
    float exponent;
    float rim;      // strength of the mirrored sky
};

const Gloss WATER = Gloss(0.35, 60.0, 0.55);
const Gloss MATTE = Gloss(0.06, 24.0, 0.06); // data modes: the hue must stay readable
const Gloss STONE = Gloss(0.12, 20.0, 0.10);

const float FLOOR_SHADOW = 0.42; // how much of the floor's light is the key light's

// light: share of the key light that arrives. All directions unit length, pointing away from the surface.
vec3 shade(vec3 albedo, Gloss gloss, vec3 normal, vec3 to_eye, vec3 to_light, float light)
{
    float facing = max(dot(normal, to_light), 0.0);
    vec3 mirrored = reflect(-to_light, normal);
    float highlight = facing > 0.0 ? pow(max(dot(mirrored, to_eye), 0.0), gloss.exponent) : 0.0;
    float away = 1.0 - max(dot(normal, to_eye), 0.0);
    float grazing = away * away * away * away;
    vec3 diffuse = albedo * (0.75 * light * facing * KEY_LIGHT + 0.62 * ambient_light(normal));
    vec3 sky = SKY_LIGHT * (0.35 + 0.65 * max(normal.y, 0.0));
    return diffuse + gloss.specular * light * highlight * KEY_LIGHT + gloss.rim * grazing * sky;
}

#endif
