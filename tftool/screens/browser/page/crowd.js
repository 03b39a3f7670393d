// @ts-check
// Many small things as one mesh. A processor that plays graphics card pays for every instance as
// for a picture of its own; put together here, hundreds of frames are drawn at once.
import { BufferAttribute, BufferGeometry, DoubleSide, DynamicDrawUsage, Mesh, MeshBasicMaterial } from "three";

const SHADES = [1, 0.82, 0.66]; // of the faces of a shape, in turn

export class Crowd {
  constructor() {
    const material = new MeshBasicMaterial({ vertexColors: true, transparent: true, side: DoubleSide });
    this.mesh = new Mesh(new BufferGeometry(), material);
    this.mesh.frustumCulled = false;
    this.room = 0; // corners that fit
    this.count = 0;
    this.places = new Float32Array(0);
    this.colors = new Float32Array(0);
    this.begin();
  }

  begin() {
    this.count = 0;
    this.mesh.visible = false;
  }

  /** Add a shape, given by the corners of its triangles, moved by a matrix. */
  add(corners, { elements: m }, [red, green, blue], alpha) {
    const many = corners.length / 3;
    if (this.count + many > this.room) this.grow(this.count + many);
    const { places, colors } = this;
    for (let corner = 0; corner < many; corner++) {
      const x = corners[3 * corner];
      const y = corners[3 * corner + 1];
      const z = corners[3 * corner + 2];
      let at = 3 * this.count;
      places[at] = m[0] * x + m[4] * y + m[8] * z + m[12];
      places[at + 1] = m[1] * x + m[5] * y + m[9] * z + m[13];
      places[at + 2] = m[2] * x + m[6] * y + m[10] * z + m[14];
      const shade = SHADES[Math.floor(corner / 3) % 3];
      at = 4 * this.count++;
      colors[at] = red * shade;
      colors[at + 1] = green * shade;
      colors[at + 2] = blue * shade;
      colors[at + 3] = alpha;
    }
  }

  end() {
    const { geometry } = this.mesh;
    this.mesh.visible = this.count > 0;
    if (!this.count) return;
    geometry.setDrawRange(0, this.count);
    geometry.attributes.position.needsUpdate = geometry.attributes.color.needsUpdate = true;
  }

  grow(least) {
    this.room = Math.max(4096, 2 ** Math.ceil(Math.log2(least)));
    const wider = (old, size) => {
      const array = new Float32Array(size * this.room);
      array.set(old);
      return array;
    };
    this.places = wider(this.places, 3);
    this.colors = wider(this.colors, 4);
    this.mesh.geometry.dispose();
    this.mesh.geometry = new BufferGeometry();
    this.mesh.geometry.setAttribute("position", new BufferAttribute(this.places, 3).setUsage(DynamicDrawUsage));
    this.mesh.geometry.setAttribute("color", new BufferAttribute(this.colors, 4).setUsage(DynamicDrawUsage));
  }
}
