//Maya ASCII 2022 scene
