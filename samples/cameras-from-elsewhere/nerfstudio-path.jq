# nerfstudio, camera_path.json. NAME: the place in the path, from 0. World: the trained scene, turned and scaled by
# dataparser_transforms.json. The camera looks along -z, fov is vertical; types other than "perspective" are refused.
.camera_path[$name | tonumber] as $camera
| {convention: "opengl",
   worldFromCamera: ($camera.camera_to_world | [.[0:4], .[4:8], .[8:12]]),
   projection: {type: (.camera_type // "perspective"), fovY: $camera.fov},
   viewport: {width: .render_width, height: .render_height}}
