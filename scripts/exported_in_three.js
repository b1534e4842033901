// Draws a GLB with three.js as one of our cameras would see it; called from Python.
import {
  AmbientLight, Color, DirectionalLight, FloatType, FrontSide, MeshLambertMaterial,
  NoBlending, PerspectiveCamera, Scene, ShaderMaterial, Vector3,
  WebGLRenderer, WebGLRenderTarget,
} from "three";
import { GLTFLoader } from "three/addons/loaders/GLTFLoader.js";

const SKY = new Color(0.72, 0.81, 0.92);
// Lights as in world/cameras/visual_scene.py, z up; they add up brighter in
// three.js, which adds light, where OpenGL adds what the screen is told.
const AMBIENT = 0.47;
const RIG = [
  [[0.12, 0.07, -1.0], 0.46], [[-0.1, 0.15, 1.0], 0.36], [[1.0, 0.35, -0.25], 0.34],
  [[-1.0, -0.3, -0.25], 0.24], [[0.3, -1.0, -0.25], 0.42], [[-0.35, 1.0, -0.25], 0.3],
];

function yUp([x, y, z]) {
  return new Vector3(x, z, -y);
}

// Our own pictures have none.
function withoutHighlights(made) {
  const kept = ["name", "color", "map", "emissive", "emissiveMap", "emissiveIntensity",
    "opacity", "transparent", "depthWrite", "side"];
  return new MeshLambertMaterial(
    Object.fromEntries(kept.map((name) => [name, made[name]])),
  );
}

function numbered(number) {
  return new ShaderMaterial({
    uniforms: { number: { value: number } },
    vertexShader: `varying float ahead;
      void main() {
        vec4 seen = modelViewMatrix * vec4(position, 1.0);
        ahead = -seen.z;
        gl_Position = projectionMatrix * seen;
      }`,
    fragmentShader: `uniform float number; varying float ahead;
      void main() { gl_FragColor = vec4(number, ahead, 0.0, 1.0); }`,
    side: FrontSide,
    blending: NoBlending,
  });
}

function base64(bytes) {
  let text = "";
  for (let at = 0; at < bytes.length; at += 32768) {
    text += String.fromCharCode(...bytes.subarray(at, at + 32768));
  }
  return btoa(text);
}

async function load(width, height) {
  const gltf = await new GLTFLoader().loadAsync("/building.glb");
  const renderer = new WebGLRenderer({ antialias: true, preserveDrawingBuffer: true });
  renderer.setSize(width, height);
  document.body.append(renderer.domElement);
  const scene = new Scene();
  scene.background = SKY;
  scene.add(gltf.scene);
  gltf.scene.traverse((each) => {
    if (each.isMesh) each.material = withoutHighlights(each.material);
  });
  scene.add(new AmbientLight(0xffffff, Math.PI * AMBIENT));
  for (const [direction, strength] of RIG) {
    const light = new DirectionalLight(0xffffff, strength * 1.22);
    light.position.copy(yUp(direction).multiplyScalar(-1));
    scene.add(light);
  }
  return { renderer, scene };
}

// Names of the nodes with meshes; pictures of numbers hold their places in this list.
function meshesOf(scene) {
  const meshes = [];
  scene.traverse((each) => {
    if (each.isMesh) {
      // A mesh of several materials is a group of meshes under the node.
      const node = each.userData.kind ? each : each.parent;
      meshes.push([node.userData.id, node.userData.kind, each]);
    }
  });
  return meshes;
}

function aim(pose, height, fov, width, tall) {
  const vertical = 2 * Math.atan((Math.tan(fov / 2) * tall) / width);
  const camera = new PerspectiveCamera((vertical * 180) / Math.PI, width / tall, 0.05, 100);
  const [x, y, heading] = pose;
  camera.position.copy(yUp([x, y, height]));
  camera.lookAt(yUp([x + Math.cos(heading), y + Math.sin(heading), height]));
  camera.updateMatrixWorld();
  return camera;
}

function numbers(renderer, scene, camera, width, tall) {
  const target = new WebGLRenderTarget(width, tall, { type: FloatType });
  const meshes = meshesOf(scene);
  const kept = meshes.map(([, , mesh]) => mesh.material);
  meshes.forEach(([, kind, mesh], number) => {
    mesh.material = numbered(number + 1);
    mesh.visible = kind !== "shade";
  });
  scene.background = null;
  renderer.setClearColor(0x000000, 0);
  renderer.setRenderTarget(target);
  renderer.clear();
  renderer.render(scene, camera);
  const values = new Float32Array(width * tall * 4);
  renderer.readRenderTargetPixels(target, 0, 0, width, tall, values);
  renderer.setRenderTarget(null);
  target.dispose();
  meshes.forEach(([, , mesh], number) => {
    mesh.material.dispose();
    mesh.material = kept[number];
    mesh.visible = true;
  });
  scene.background = SKY;
  return base64(new Uint8Array(values.buffer));
}

window.open_building = async (width, tall) => {
  const { renderer, scene } = await load(width, tall);
  window.building = { renderer, scene, width, tall };
  return meshesOf(scene).map(([id, kind]) => [id, kind]);
};

window.picture_from = (pose, height, fov) => {
  const { renderer, scene, width, tall } = window.building;
  const camera = aim(pose, height, fov, width, tall);
  renderer.render(scene, camera);
  const rgb = renderer.domElement.toDataURL("image/png");
  return [rgb, numbers(renderer, scene, camera, width, tall)];
};
window.is_ready = true;
