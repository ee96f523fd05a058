"""What is said of binary formats of scans: notes, and why a file is not read."""

from __future__ import annotations

from aadm_workbench.model.sentences import Sentence

SENTENCES: dict[str, Sentence] = {
    "formats.digits": Sentence("a number of {count} digits", "有 {count} 位数字的数"),
    "formats.e57_announces": Sentence(
        "its XML part announces {records} points of {bits} bits, more than its {size_bytes} bytes have room for "
        "or than any scan has: it is cut off or wrong; copy or export it again",
        "XML 部分声明有 {records} 个 {bits} 位的点，超出其 {size_bytes} "
        "字节所能容纳或任何扫描的规模：文件不完整或有误；请重新拷贝或导出",
    ),
    "formats.e57_count": Sentence(
        "announces {count} points and holds {found}: it is cut off or wrong; copy or export it again",
        "声明有 {count} 个点，实有 {found} 个：文件不完整或有误；请重新拷贝或导出",
    ),
    "formats.e57_deep": Sentence("is nested more than {most} deep", "嵌套超过 {most} 层"),
    "formats.e57_doctype": Sentence("declares its own document type", "声明了自己的文档类型"),
    "formats.e57_entities": Sentence("declares entities", "声明了实体"),
    "formats.e57_harm": Sentence(
        "its XML part {what}, which no exporter writes: it may be meant to harm; do not use it",
        "XML 部分{what}，没有软件这样导出：可能有恶意；请勿使用",
    ),
    "formats.e57_many": Sentence("announces more than {most} scans", "声明的扫描多于 {most} 个"),
    "formats.e57_metres": Sentence("an E57 file is in metres", "E57 文件以米为单位"),
    "formats.e57_no_coordinates": Sentence(
        "scan {number} has neither cartesian nor spherical coordinates; export x, y, z",
        "扫描 {number} 既无直角坐标也无球坐标；请导出 x、y、z",
    ),
    "formats.e57_pages": Sentence(
        "its header says pages of {page_bytes} bytes, they have 1024; export it again",
        "文件头声明每页 {page_bytes} 字节，应为 1024；请重新导出",
    ),
    "formats.e57_size": Sentence(
        "should have {file_bytes} bytes and has {size_bytes}: it is cut off; copy it again",
        "应有 {file_bytes} 字节，实有 {size_bytes} 字节：文件不完整；请重新拷贝",
    ),
    "formats.e57_unreadable": Sentence(
        "cannot be read as E57 ({why}); copy or export it again",
        "无法按 E57 读取（{why}）；请重新拷贝或导出",
    ),
    "formats.e57_xml": Sentence(
        "its XML part cannot be read ({why}); copy or export it again",
        "XML 部分无法读取（{why}）；请重新拷贝或导出",
    ),
    "formats.e57_xml_place": Sentence(
        "its XML part should be {xml_bytes} bytes at byte {xml_at}, which cannot be; export it again",
        "XML 部分应有 {xml_bytes} 字节、位于第 {xml_at} 字节，这不可能；请重新导出",
    ),
    "formats.ends_in_header": Sentence(
        "ends at byte {size_bytes}, within its header; copy or export it again",
        "在第 {size_bytes} 字节处、文件头内结束；请重新拷贝或导出",
    ),
    "formats.las_count": Sentence(
        "its header announces {count} points, more than any scan; crop it to the component",
        "文件头声明有 {count} 个点，超出任何扫描的规模；请裁剪到构件范围",
    ),
    "formats.las_degrees": Sentence(
        "its coordinates are degrees of longitude and latitude; export it in metres or millimetres",
        "坐标是经纬度；请以米或毫米导出",
    ),
    "formats.las_header": Sentence(
        "its LAS 1.4 header has {header_bytes} bytes, 375 are the least; export it again",
        "LAS 1.4 文件头只有 {header_bytes} 字节，至少应有 375；请重新导出",
    ),
    "formats.las_overrun": Sentence(
        "its variable length record {number} of {count} runs into its points; export it again",
        "第 {number} 个（共 {count} 个）可变长度记录伸入点数据；请重新导出",
    ),
    "formats.las_record": Sentence(
        "its points of format {point_format} have {record_bytes} bytes: that cannot be; export it again",
        "格式 {point_format} 的点为 {record_bytes} 字节，这不可能；请重新导出",
    ),
    "formats.las_records": Sentence(
        "its header announces {count} variable length records, which cannot be; export it again",
        "文件头声明有 {count} 个可变长度记录，这不可能；请重新导出",
    ),
    "formats.las_scales": Sentence(
        "its scales and offsets, {numbers}, must be finite, scales not 0; export it again",
        "比例和偏移 {numbers} 必须为有限数，且比例不为 0；请重新导出",
    ),
    "formats.las_start": Sentence(
        "its points should begin at byte {start}, but it has {size_bytes} bytes; copy it again",
        "点应从第 {start} 字节开始，但文件只有 {size_bytes} 字节；请重新拷贝",
    ),
    "formats.las_unit": Sentence("its coordinate system says {name}", "其坐标系声明为 {name}"),
    "formats.las_units_differ": Sentence(
        "its heights are in {other}, its plane in {name}; convert it to one unit",
        "高程单位为 {other}，平面单位为 {name}；请统一为一种单位",
    ),
    "formats.las_version": Sentence(
        "is LAS version {major}.{minor}; known are 1.0 to 1.4, export it as one of them",
        "LAS 版本为 {major}.{minor}；支持 1.0 至 1.4，请按其中之一导出",
    ),
    "formats.laz_chunk": Sentence(
        "chunk {chunk} of {chunks}, at byte {position}, is longer than the file; copy it again",
        "第 {chunk} 个（共 {chunks} 个）数据块位于第 {position} 字节，比文件还长；请重新拷贝",
    ),
    "formats.laz_chunks": Sentence(
        "its table announces {chunks} chunks of points, {needed} are needed; export it again",
        "表中声明有 {chunks} 个数据块，应有 {needed} 个；请重新导出",
    ),
    "formats.laz_table": Sentence(
        "its table of chunks should stand at byte {table} of {size_bytes}; copy it again",
        "数据块表应在第 {table} 字节，而文件只有 {size_bytes} 字节；请重新拷贝",
    ),
    "formats.laz_table_version": Sentence(
        "its table of chunks, at byte {table}, is of version {version}, not 0; copy or export it again",
        "第 {table} 字节处的数据块表版本为 {version}，不是 0；请重新拷贝或导出",
    ),
    "formats.laz_too_many": Sentence(
        "its table announces {chunks} chunks of points, more than it has room for; export it again",
        "表中声明有 {chunks} 个数据块，超出其容量；请重新导出",
    ),
    "formats.laz_unfit": Sentence(
        "is packed in a way that does not fit its points; export it again, or as LAS",
        "压缩方式与其点不符；请重新导出，或导出为 LAS",
    ),
    "formats.laz_unpack": Sentence(
        "its points {first} to {last} of {count} do not unpack ({why}): it is cut off or damaged; copy or export "
        "it again",
        "第 {first} 至 {last} 个点（共 {count} 个）无法解压（{why}）：文件不完整或损坏；请重新拷贝或导出",
    ),
    "formats.laz_unsaid": Sentence(
        "is packed, but does not say how (no LASzip record); export it again",
        "已压缩，但未说明方式（没有 LASzip 记录）；请重新导出",
    ),
    "formats.no_e57": Sentence(
        'does not begin with "ASTM-E57": it is no E57 file; check its extension',
        '开头不是 "ASTM-E57"：不是 E57 文件；请检查扩展名',
    ),
    "formats.no_las": Sentence(
        'does not begin with "LASF": it is no LAS or LAZ file; check its extension',
        '开头不是 "LASF"：不是 LAS 或 LAZ 文件；请检查扩展名',
    ),
    "formats.no_rotation": Sentence(
        "the rotation in its pose is 0 0 0 0, which is none: the pose was taken not to turn",
        "位姿中的旋转为 0 0 0 0，无效：按无旋转处理",
    ),
    "formats.npz_damaged": Sentence(
        "is damaged or no .npz archive ({why}); copy or save it again",
        "已损坏或不是 .npz 文件（{why}）；请重新拷贝或保存",
    ),
    "formats.npz_header": Sentence(
        "its array {name} has no header that can be read ({why}); save it again",
        "数组 {name} 的文件头无法读取（{why}）；请重新保存",
    ),
    "formats.npz_large": Sentence(
        "its array {name} of shape {shape} is larger than any scan; crop it to the component",
        "数组 {name} 的形状 {shape} 超出任何扫描的规模；请裁剪到构件范围",
    ),
    "formats.npz_no_array": Sentence(
        'has no array "points" or "depth" (only {names}); save one of them',
        '没有数组 "points" 或 "depth"（只有 {names}）；请保存其中之一',
    ),
    "formats.npz_packed": Sentence(
        "its array {name} is packed in a way that NumPy does not use; save it again",
        "数组 {name} 的压缩方式不是 NumPy 所用；请重新保存",
    ),
    "formats.npz_short": Sentence(
        "its array {name} of shape {shape} has {found_bytes} of {size_bytes} bytes; save it again",
        "数组 {name}（形状 {shape}）应有 {size_bytes} 字节，只有 {found_bytes} 字节；请重新保存",
    ),
    "formats.npz_type": Sentence(
        "its array {name} is {dtype} of shape {shape}, but must be numbers of shape {needed}",
        "数组 {name} 为 {dtype}、形状 {shape}，应为数值、形状 {needed}",
    ),
    "formats.page": Sentence("{width} x {height} pixels of {bits} bits", "{width} x {height} 像素、{bits} 位"),
    "formats.page.floating": Sentence(
        "{width} x {height} pixels of {bits} bits floating",
        "{width} x {height} 像素、{bits} 位浮点",
    ),
    "formats.rotation": Sentence(
        "the rotation of a scan is {quaternion}, which is none; export it again",
        "扫描的旋转为 {quaternion}，无效；请重新导出",
    ),
    "formats.tiff_as_it_is": Sentence("{name}: {what}. As it is it", "{name}：{what}。否则"),
    "formats.tiff_directory": Sentence("the directory lies behind the end", "图像目录在文件末尾之后"),
    "formats.tiff_half": Sentence(
        "holds 16-bit floats: save it as 32-bit floats",
        "是 16 位浮点数：请存为 32 位浮点数",
    ),
    "formats.tiff_method": Sentence("method {number}", "方式 {number}"),
    "formats.tiff_packed": Sentence(
        "is compressed with {packed}: save it uncompressed or with deflate",
        "以 {packed} 压缩：请不压缩或用 deflate 保存",
    ),
    "formats.tiff_shape": Sentence(
        "unpacks to an array of {shape} where {wanted} is announced; export it again",
        "解压得到 {shape} 的数组，而声明为 {wanted}；请重新导出",
    ),
    "formats.tiff_unpack": Sentence(
        "cannot be unpacked ({why}); copy or export it again",
        "无法解压（{why}）；请重新拷贝或导出",
    ),
    "formats.tiff_xyz": Sentence(
        "is a map of X, Y and Z: save it as .ply or .npz, or save its depth (Z) alone with the intrinsics",
        "是 X、Y、Z 图：请存为 .ply 或 .npz，或单独保存深度（Z）及内参",
    ),
    "formats.translation": Sentence(
        "the translation of a scan is not finite; export it again",
        "扫描的平移不是有限数；请重新导出",
    ),
}
