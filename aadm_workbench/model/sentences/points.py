"""What is said of clouds in PCD, PLY, PTS, PTX and plain text."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "points.bad_row": Sentence(
        "line {number} should begin with {needed} numbers, but reads {shown}; export it again",
        "第 {number} 行应以 {needed} 个数开头，实为 {shown}；请重新导出",
    ),
    "points.bad_rows": Sentence(
        "its points cannot be read ({why}, counted from line {first_line}); export it again",
        "点无法读取（{why}，自第 {first_line} 行起计）；请重新导出",
    ),
    "points.long_line": Sentence(
        "has a line of over {most_bytes} bytes at byte {place}: it is no text of points",
        "第 {place} 字节处有超过 {most_bytes} 字节的行：不是点的文本",
    ),
    "points.long_row": Sentence(
        "has a line of over {most_bytes} bytes around byte {place}: it is no text of points",
        "第 {place} 字节附近有超过 {most_bytes} 字节的行：不是点的文本",
    ),
    "points.no_pcd": Sentence(
        "has no PCD header ending in a DATA line: it is no PCD file or cut off; export it again",
        "没有以 DATA 行结尾的 PCD 文件头：不是 PCD 文件或文件不完整；请重新导出",
    ),
    "points.no_ply": Sentence(
        'does not begin with "ply": it is no PLY file; check its extension',
        '开头不是 "ply"：不是 PLY 文件；请检查扩展名',
    ),
    "points.no_points": Sentence("holds no points; export the scan again", "没有点；请重新导出扫描"),
    "points.no_records": Sentence(
        "its header announces 0 points; export the scan again",
        "文件头声明有 0 个点；请重新导出扫描",
    ),
    "points.no_text": Sentence(
        "is not plain text; save it as text in UTF-8 or name its real format by its extension",
        "不是纯文本；请存为 UTF-8 文本，或用扩展名标明其真实格式",
    ),
    "points.pcd_cut": Sentence(
        "its compressed points take {packed_bytes} bytes from byte {start} on, but the file has {size_bytes} "
        "bytes: it is cut off; copy or export it again",
        "压缩点从第 {start} 字节起占 {packed_bytes} 字节，而文件只有 {size_bytes} 字节：文件不完整；请重新拷贝或导出",
    ),
    "points.pcd_damaged": Sentence(
        "its compressed points (bytes {start} to {end}) do not unpack to {count} points: the file is damaged; "
        "copy or export it again",
        "压缩点（第 {start} 至 {end} 字节）解压后不是 {count} 个点：文件损坏；请重新拷贝或导出",
    ),
    "points.pcd_ends": Sentence(
        "ends at byte {size_bytes}, before its compressed points; copy or export it again",
        "在第 {size_bytes} 字节处、压缩点之前结束；请重新拷贝或导出",
    ),
    "points.pcd_fields": Sentence(
        "its points have no single value {missing} (fields: {names}); export x, y, z",
        "点没有单值的 {missing}（字段：{names}）；请导出 x、y、z",
    ),
    "points.pcd_has_no": Sentence(
        "its PCD header has no {key}; it should list whole numbers from {least} on; export it again",
        "PCD 文件头没有 {key}；应列出不小于 {least} 的整数；请重新导出",
    ),
    "points.pcd_header_wrong": Sentence(
        "its header announces {count} points of {step_bytes} bytes, but {packed_bytes} packed bytes are to unpack "
        "to {unpacked_bytes}: its header is wrong; export it again",
        "文件头声明有 {count} 个 {step_bytes} 字节的点，而 {packed_bytes} 压缩字节应解压为 {unpacked_bytes} "
        "字节：文件头有误；请重新导出",
    ),
    "points.pcd_lengths": Sentence(
        "FIELDS, SIZE, TYPE and COUNT of its PCD header differ in length; export it again",
        "PCD 文件头的 FIELDS、SIZE、TYPE 和 COUNT 长度不一；请重新导出",
    ),
    "points.pcd_points": Sentence(
        "its PCD header says POINTS {points}, but WIDTH {width} x HEIGHT {height}; export it again",
        "PCD 文件头声明 POINTS {points}，而 WIDTH {width} x HEIGHT {height}；请重新导出",
    ),
    "points.pcd_says": Sentence(
        "its PCD header says {key} {said}; it should list whole numbers from {least} on; export it again",
        "PCD 文件头声明 {key} {said}；应列出不小于 {least} 的整数；请重新导出",
    ),
    "points.pcd_storage": Sentence(
        "its PCD header says DATA {storage}; known are {known}",
        "PCD 文件头声明 DATA {storage}；支持 {known}",
    ),
    "points.pcd_types": Sentence(
        "its PCD header has values of unknown type ({unknown}); export it again",
        "PCD 文件头中有未知类型的值（{unknown}）；请重新导出",
    ),
    "points.pcd_viewpoint": Sentence(
        "its PCD header says VIEWPOINT {said}; it should be a translation and a quaternion w x y z; where it is "
        "not known, write VIEWPOINT 0 0 0 1 0 0 0",
        "PCD 文件头声明 VIEWPOINT {said}；应为平移和四元数 w x y z；未知时请写 VIEWPOINT 0 0 0 1 0 0 0",
    ),
    "points.ply_ends": Sentence(
        "ends within its element {name}, before the points; copy or export it again",
        "在元素 {name} 内、点之前结束；请重新拷贝或导出",
    ),
    "points.ply_line": Sentence(
        "line {number} of its PLY header makes no sense: {line}; export it again",
        "PLY 文件头第 {number} 行无法理解：{line}；请重新导出",
    ),
    "points.ply_list": Sentence(
        "its vertices have a list property; export the cloud without it",
        "顶点含列表属性；请导出时去掉",
    ),
    "points.ply_missing": Sentence(
        "its vertices have no property {missing} (only {present}); export x, y, z",
        "顶点没有属性 {missing}（只有 {present}）；请导出 x、y、z",
    ),
    "points.ply_no_end": Sentence(
        "its PLY header, {count} lines, has no end_header: it is cut off; export it again",
        "PLY 文件头有 {count} 行而没有 end_header：文件不完整；请重新导出",
    ),
    "points.ply_no_format": Sentence(
        "its PLY header has no format line; export it again",
        "PLY 文件头没有 format 行；请重新导出",
    ),
    "points.ply_no_vertex": Sentence(
        'its PLY header has no element "vertex": it holds no points; export the cloud',
        'PLY 文件头没有元素 "vertex"：没有点；请导出点云',
    ),
    "points.ply_row_end": Sentence(
        "row {row} of {count} of its element {name} runs past the end of the file ({size_bytes} bytes): it is cut "
        "off or wrong; export it again",
        "元素 {name} 的第 {row} 行（共 {count} 行）超出文件末尾（{size_bytes} 字节）：文件不完整或有误；请重新导出",
    ),
    "points.ply_rows": Sentence(
        "{count} rows of its element {name} stand before its points, which are no triangles; export the points "
        "first, or alone",
        "元素 {name} 的 {count} 行在点之前，且不是三角形；请先导出点，或只导出点",
    ),
    "points.pts_block_end": Sentence(
        "before line {place} a block of {count} points should have ended, but {line} follows; copy or export it again",
        "第 {place} 行之前，{count} 个点的块应已结束，但其后是 {line}；请重新拷贝或导出",
    ),
    "points.pts_blocks": Sentence("holds {count} blocks of points, which were joined", "含 {count} 个点块，已合并"),
    "points.pts_too_many": Sentence(
        "holds more than {most} blocks of points; export those of the component alone",
        "点块多于 {most} 个；请只导出构件的点",
    ),
    "points.ptx_line": Sentence(
        "line {place} should be line {number} of 10 of a PTX header, {count} number, but reads {line}; export it again",
        "第 {place} 行应为 PTX 文件头 10 行中的第 {number} 行，含 {count} 个数，实为 {line}；请重新导出",
    ),
    "points.ptx_line.several": Sentence(
        "line {place} should be line {number} of 10 of a PTX header, {count} numbers, but reads {line}; export it "
        "again",
        "第 {place} 行应为 PTX 文件头 10 行中的第 {number} 行，含 {count} 个数，实为 {line}；请重新导出",
    ),
    "points.ptx_size": Sentence(
        "a PTX header says {columns:g} columns, {rows:g} rows; they must be whole; export it again",
        "PTX 文件头声明 {columns:g} 列、{rows:g} 行，必须为整数；请重新导出",
    ),
    "points.ptx_too_many": Sentence(
        "holds more than {most} scans; export those of the component alone",
        "扫描多于 {most} 个；请只导出构件的扫描",
    ),
    "points.ptx_transform": Sentence(
        "the transform before byte {position} is none of space; export it again",
        "第 {position} 字节之前的变换不是空间变换；请重新导出",
    ),
    "points.records_short": Sentence(
        "its header announces {count} points of at least {record_bytes} bytes from byte {start} on, but the file "
        "has {size_bytes} bytes, room for {found} points: it is cut off or its header is wrong; copy or export it "
        "again",
        "文件头声明从第 {start} 字节起有 {count} 个至少 {record_bytes} 字节的点，而文件只有 {size_bytes} 字节，容 "
        "{found} 个点：文件不完整或文件头有误；请重新拷贝或导出",
    ),
    "points.rows_short": Sentence(
        "its header announces {count} points, but after {found} of them the file ends (at byte {size_bytes}): it "
        "is cut off or its header is wrong; copy or export it again",
        "文件头声明有 {count} 个点，而 {found} 个之后文件就结束（在第 {size_bytes} "
        "字节）：文件不完整或文件头有误；请重新拷贝或导出",
    ),
    "points.text_columns": Sentence(
        "does not tell which of its columns are x, y and z ({shown}); call them x, y and z there",
        "看不出哪几列是 x、y、z（{shown}）；请在首行标明 x、y、z",
    ),
    "points.text_commas": Sentence(
        "has commas between its columns and, it seems, in its numbers ({shown}); export it with decimal points, "
        "or with semicolons between the columns",
        "列间有逗号，数中似乎也有逗号（{shown}）；请用小数点导出，或用分号分列",
    ),
    "points.text_count": Sentence(
        "its first line announces {count} points, {found} follow; copy or export it again",
        "首行声明有 {count} 个点，其后有 {found} 个；请重新拷贝或导出",
    ),
    "points.text_counts": Sentence("its first column counts its points and was left out", "第一列是点号，未采用"),
    "points.text_line": Sentence(
        "line {number} should begin with three numbers, but reads {text}",
        "第 {number} 行应以三个数开头，实为 {text}",
    ),
    "points.text_no_row": Sentence(
        "holds no row of three numbers; export the points as rows of x, y, z",
        "没有三个数的行；请按 x、y、z 成行导出点",
    ),
    "points.text_not_x": Sentence(
        "its first column ({shown}, ...) does not look like x; name the columns in a first line, such as: "
        "intensity x y z",
        "第一列（{shown}、…）不像 x；请在首行写列名，例如：intensity x y z",
    ),
    "points.text_unit": Sentence("the names of its columns say so", "列名标明了单位"),
}
