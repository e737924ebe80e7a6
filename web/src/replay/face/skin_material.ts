// SPDX-License-Identifier: GPL-3.0-or-later
// How skin takes light: it scatters below the surface, so that shadows begin late and red; it shines faintly where it is
// seen along the surface; folds and sockets get less light from all sides. Adds little to three's own material, since the
// processor may have to draw it.
import { DoubleSide, MeshStandardMaterial } from 'three';

/** By how much light reaches around the surface, by channel. Red scatters farthest (d'Eon, Luebke and Enderton,
 *  "Efficient rendering of human skin", 2007): wrapped diffuse light after Green, "GPU Gems" (2004), chapter 16. */
const wrap = 'vec3(0.36, 0.16, 0.10)';

/** Attributes of a vertex: the share of light from all sides that reaches it, and how far the skin has faded out there, 0
 *  where it ends. */
const attributes = 'attribute vec2 lightAndFade;\nvarying vec2 vLightAndFade;';

export function skinMaterial(): MeshStandardMaterial {
  const material = new MeshStandardMaterial({
    color: '#e0aa91', roughness: 0.52, metalness: 0, side: DoubleSide, transparent: true,
    // Else three.js draws the back and the front one after the other, each by a shader of its own.
    forceSinglePass: true,
  });
  material.onBeforeCompile = (shader) => {
    shader.vertexShader = shader.vertexShader
      .replace('#include <common>', `#include <common>\n${attributes}`)
      .replace('#include <begin_vertex>', '#include <begin_vertex>\nvLightAndFade = lightAndFade;');
    shader.fragmentShader = shader.fragmentShader
      .replace('#include <common>', '#include <common>\nvarying vec2 vLightAndFade;')
      .replace(
        '#include <lights_physical_pars_fragment>',
        `#include <lights_physical_pars_fragment>
void skinDirect( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
  float facing = dot( geometryNormal, directLight.direction );
  vec3 scattered = clamp( ( vec3( facing ) + ${wrap} ) / ( 1.0 + ${wrap} ), 0.0, 1.0 );
  float open = mix( 0.55, 1.0, vLightAndFade.x );
  reflectedLight.directDiffuse += open * scattered * scattered * directLight.color * BRDF_Lambert( material.diffuseColor );
  reflectedLight.directSpecular += open * saturate( facing ) * directLight.color * BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
}
#undef RE_Direct
#define RE_Direct skinDirect`,
      )
      .replace(
        '#include <aomap_fragment>',
        `// Light that comes back from near-by skin is red itself.
vec3 reached = pow( vec3( vLightAndFade.x ), vec3( 1.0, 1.25, 1.35 ) );
reflectedLight.indirectDiffuse *= reached;
float along = 1.0 - saturate( dot( normal, geometryViewDir ) );
reflectedLight.indirectDiffuse += 0.22 * along * along * along * vLightAndFade.x * mix( vec3( 1.0 ), diffuseColor.rgb, 0.6 );`,
      )
      .replace('#include <opaque_fragment>', 'diffuseColor.a *= vLightAndFade.y;\n#include <opaque_fragment>');
  };
  return material;
}
