// @ts-check
// Many solids as one mesh: each vertex has the number of its link, and a texture has the poses of
// the links. Hundreds of shapes are drawn in one call, and only the links' poses are sent to the GPU.
import {
  BufferAttribute,
  Box3,
  BufferGeometry,
  DataTexture,
  DoubleSide,
  FloatType,
  Matrix3,
  Matrix4,
  Mesh,
  MeshBasicMaterial,
  NearestFilter,
  RGBAFormat,
  Vector3,
} from "three";

const PLACED = `
attribute float link;
uniform highp sampler2D places;
varying float vShade;
mat4 placeOf(float link) {
  int row = int(link + 0.5);
  return mat4(texelFetch(places, ivec2(0, row), 0), texelFetch(places, ivec2(1, row), 0),
              texelFetch(places, ivec2(2, row), 0), texelFetch(places, ivec2(3, row), 0));
}
`;
// Light from above and from one side, computed per vertex, which is cheapest.
const SHADED = `
mat4 place = placeOf(link);
vec3 transformed = (place * vec4(position, 1.0)).xyz;
vec3 outward = normalize(mat3(place) * normal + vec3(0.0, 0.0, 1e-9));
float lamp = 0.5 + 0.5 * dot(outward, vec3(-0.32, -0.42, 0.85));
vShade = 0.5 + 0.14 * (1.0 + outward.z) + 0.34 * lamp * lamp;
`;

/** Poses of links, shared by all `Solids` with these links. */
export class Places {
  /** @param {number} count */
  constructor(count) {
    this.numbers = new Float32Array(16 * Math.max(1, count));
    this.texture = new DataTexture(this.numbers, 4, Math.max(1, count), RGBAFormat, FloatType);
    this.texture.minFilter = this.texture.magFilter = NearestFilter;
  }

  /** Hide every link until it is placed. */
  clear() {
    this.numbers.fill(0);
    this.texture.needsUpdate = true;
  }

  /** @param {number} link @param {import("three").Matrix4} matrix */
  put(link, matrix) {
    matrix.toArray(this.numbers, 16 * link);
  }
}

export class Solids {
  /** @param {Places} places */
  constructor(places) {
    this.places = places;
    /** @type {{ link: number, geometry: BufferGeometry, matrix: import("three").Matrix4, color: number[] }[]} */
    this.parts = [];
    this.isDirty = false;
    this.isClear = false; // whether a part has a transparent colour
    this.material = new MeshBasicMaterial({ vertexColors: true, side: DoubleSide });
    this.material.onBeforeCompile = (shader) => {
      shader.uniforms.places = { value: places.texture };
      shader.vertexShader = PLACED + shader.vertexShader.replace("#include <begin_vertex>", SHADED);
      shader.fragmentShader = `varying float vShade;\n${shader.fragmentShader.replace(
        "#include <opaque_fragment>",
        "outgoingLight *= vShade;\n#include <opaque_fragment>",
      )}`;
    };
    this.mesh = new Mesh(new BufferGeometry(), this.material);
    this.mesh.frustumCulled = false;
    this.mesh.matrixAutoUpdate = false;
  }

  /**
   * Add a shape to a link.
   * @param {number} link
   * @param {BufferGeometry} geometry
   * @param {import("three").Matrix4} matrix where it is on its link
   * @param {number[]} color red, green, blue in linear light, and opacity
   */
  add(link, geometry, matrix, color) {
    this.parts.push({ link, geometry, matrix, color });
    this.isDirty = true;
    if (color[3] < 1) this.isClear = true;
  }

  /** @param {boolean} shown @param {number} opacity */
  show(shown, opacity) {
    if (this.isDirty) this.join();
    this.mesh.visible = shown && this.parts.length > 0;
    const clear = this.isClear || opacity < 1;
    if (this.material.transparent !== clear) {
      this.material.transparent = clear;
      this.material.depthWrite = !clear;
      this.material.needsUpdate = true;
    }
    this.material.opacity = opacity;
  }

  /** Put all parts into one geometry. */
  join() {
    this.isDirty = false;
    let corners = 0;
    let sides = 0;
    for (const { geometry } of this.parts) {
      corners += geometry.attributes.position.count;
      sides += geometry.index ? geometry.index.count : geometry.attributes.position.count;
    }
    const [places, normals] = [new Float32Array(3 * corners), new Float32Array(3 * corners)];
    const [colors, links] = [new Float32Array(4 * corners), new Float32Array(corners)];
    const index = new Uint32Array(sides);
    const point = new Vector3();
    const turned = new Matrix3();
    let at = 0;
    let side = 0;
    for (const { link, geometry, matrix, color } of this.parts) {
      if (!geometry.attributes.normal) geometry.computeVertexNormals();
      const { position, normal } = geometry.attributes;
      turned.getNormalMatrix(matrix);
      const mirrored = matrix.determinant() < 0 ? -1 : 1;
      for (let corner = 0; corner < position.count; corner++) {
        point.fromBufferAttribute(position, corner).applyMatrix4(matrix).toArray(places, 3 * (at + corner));
        point.fromBufferAttribute(normal, corner).applyMatrix3(turned).normalize().multiplyScalar(mirrored);
        point.toArray(normals, 3 * (at + corner));
        colors.set(color, 4 * (at + corner));
        links[at + corner] = link;
      }
      const count = geometry.index ? geometry.index.count : position.count;
      for (let place = 0; place < count; place++) index[side++] = at + (geometry.index ? geometry.index.getX(place) : place);
      at += position.count;
    }
    this.mesh.geometry.dispose();
    const joined = new BufferGeometry();
    joined.setAttribute("position", new BufferAttribute(places, 3));
    joined.setAttribute("normal", new BufferAttribute(normals, 3));
    joined.setAttribute("color", new BufferAttribute(colors, 4));
    joined.setAttribute("link", new BufferAttribute(links, 1));
    joined.setIndex(new BufferAttribute(index, 1));
    this.mesh.geometry = joined;
  }

  /** Pose of a part: the pose of its link, times the part's pose on the link. */
  matrixOf({ link, matrix }) {
    return new Matrix4().fromArray(this.places.numbers, 16 * link).multiply(matrix);
  }

  /** Grow a box around all parts whose links are placed. @param {Box3} box */
  surround(box) {
    for (const part of this.parts) {
      if (!this.places.numbers[16 * part.link + 15]) continue;
      if (!part.geometry.boundingBox) part.geometry.computeBoundingBox();
      if (part.geometry.boundingBox) box.union(new Box3().copy(part.geometry.boundingBox).applyMatrix4(this.matrixOf(part)));
    }
  }

  /**
   * Nearest hit of a ray, and the number of the link; null if the ray hits no link.
   * @param {import("three").Raycaster} ray
   */
  pick(ray) {
    /** @type {any} */
    let best = null;
    for (const part of this.mesh.visible ? this.parts : []) {
      if (!this.places.numbers[16 * part.link + 15]) continue;
      const solid = new Mesh(part.geometry, this.material);
      solid.matrixWorld.copy(this.matrixOf(part));
      const [hit] = ray.intersectObject(solid, false);
      if (hit && (!best || hit.distance < best.distance)) best = { link: part.link, point: hit.point, distance: hit.distance };
    }
    return best;
  }

  dispose() {
    this.mesh.removeFromParent();
    this.mesh.geometry.dispose();
    this.material.dispose();
  }
}
